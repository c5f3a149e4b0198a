#include "cli/evaluate/report/chart.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace fbs::cli {
namespace {

/// The numbers between `before` and `after` throughout the picture. No <regex>: GCC 12 warns inside it under
/// the sanitizers.
std::vector<double> all_between(const std::string& svg, const std::string& before, const std::string& after) {
  std::vector<double> out;
  for (std::size_t at = 0; (at = svg.find(before, at)) != std::string::npos;) {
    at += before.size();
    const std::size_t end = svg.find_first_not_of("-.0123456789", at);
    if (end != std::string::npos && end > at && svg.compare(end, after.size(), after) == 0)
      out.push_back(std::stod(svg.substr(at, end - at)));
  }
  return out;
}

std::vector<double> all(const std::string& svg, const std::string& attribute) {
  return all_between(svg, attribute + "=\"", "\"");
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
  const std::vector<double> y = all_between(svg, "y=\"", "\" text-anchor=\"start\" class=\"name");
  ASSERT_EQ(y.size(), 2U);
  EXPECT_GE(std::abs(y[0] - y[1]), 13.9);
}

TEST(Chart, EscapesText) {
  EXPECT_EQ(escaped("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
  EXPECT_NE(line_chart({"t", "x", "y"}, {{"<b>", "fbs", {{1, 2, ""}}}}).find("&lt;b&gt;"), std::string::npos);
}

}  // namespace
}  // namespace fbs::cli
