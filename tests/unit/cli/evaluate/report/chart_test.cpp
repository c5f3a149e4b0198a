#include "cli/evaluate/report/chart.h"

#include <gtest/gtest.h>

#include <regex>

namespace fbs::cli {
namespace {

std::vector<double> all(const std::string& svg, const std::string& attribute) {
  std::vector<double> out;
  const std::regex pattern(attribute + "=\"([-0-9.]+)\"");
  for (std::sregex_iterator i(svg.begin(), svg.end(), pattern), end; i != end; ++i)
    out.push_back(std::stod((*i)[1]));
  return out;
}

TEST(Chart, HasAMarkerForEachPointWithinTheBox) {
  const std::string svg =
      line_chart({"t", "x", "y", true}, {{"fbs", "fbs", {{1, 20, ""}, {10, 30, ""}, {100, 25, ""}}}});
  const auto x = all(svg, "cx"), y = all(svg, "cy");
  ASSERT_EQ(x.size(), 3U);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.2);  // equal ratios of rate
  EXPECT_LT(y[1], y[2]);                       // more is further up
  EXPECT_LT(y[2], y[0]);
  for (const double v : x) EXPECT_TRUE(v > 0 && v < 560);
  for (const double v : y) EXPECT_TRUE(v > 0 && v < 360);
}

TEST(Chart, OfNothingIsNothing) {
  EXPECT_EQ(line_chart({"t", "x", "y"}, {}), "");
  EXPECT_EQ(line_chart({"t", "x", "y"}, {{"fbs", "fbs", {}}}), "");
}

TEST(Chart, OfOnePointHasNoInfinity) {
  for (const bool log : {false, true}) {
    const std::string svg = line_chart({"t", "x", "y", log}, {{"fbs", "fbs", {{4, 30, "50"}}}});
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(all(svg, "cx").size(), 1U);
  }
}

TEST(Chart, NamesOfLinesDoNotCoverEachOther) {
  const std::string svg = line_chart(
      {"t", "x", "y"}, {{"one", "a", {{0, 0, ""}, {9, 30, ""}}}, {"two", "b", {{0, 5, ""}, {9, 30.1, ""}}}});
  std::vector<double> y;
  const std::regex pattern("y=\"([0-9.]+)\" text-anchor=\"start\" class=\"name");
  for (std::sregex_iterator i(svg.begin(), svg.end(), pattern), end; i != end; ++i)
    y.push_back(std::stod((*i)[1]));
  ASSERT_EQ(y.size(), 2U);
  EXPECT_GE(std::abs(y[0] - y[1]), 13.9);
}

TEST(Chart, EscapesText) {
  EXPECT_EQ(escaped("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
  EXPECT_NE(line_chart({"t", "x", "y"}, {{"<b>", "fbs", {{1, 2, ""}}}}).find("&lt;b&gt;"), std::string::npos);
}

}  // namespace
}  // namespace fbs::cli
