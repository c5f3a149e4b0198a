#include "encoder/landmarks/landmark_file.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace fbs {
namespace {

constexpr int kWidth = 200, kHeight = 160;

/// Names of the columns of the points, in the order of a table.
std::string header(const std::string& first, const std::string& joint = "") {
  std::string out = first;
  for (const char* axis : {"x", "y"})
    for (int k = 0; k < kLandmarkCount; ++k)
      out += "," + (joint.empty() ? "" : std::string(" ")) + axis + joint + std::to_string(k);
  return out + "\n";
}

/// A row whose landmarks are all different, in a face of some 60 pixels.
double x_of(int k) {
  return 60 + k;
}
double y_of(int k) {
  return 50 + 0.5 * k;
}
std::string row(const std::string& first, const std::string& x0 = "60") {
  std::string out = first;
  for (int k = 0; k < kLandmarkCount; ++k) out += "," + (k == 0 ? x0 : std::to_string(x_of(k)));
  for (int k = 0; k < kLandmarkCount; ++k) out += ", " + std::to_string(y_of(k));
  return out + "\n";
}

std::string refusal(const std::string& text) {
  const auto track = parse_landmarks(text, kWidth, kHeight);
  return track ? "accepted" : track.error().text;
}

TEST(LandmarkFile, ReadsPointsByTheirNames) {
  const auto track = parse_landmarks(header("frame") + row("0") + row("7"), kWidth, kHeight);
  ASSERT_TRUE(track) << track.error().text;
  ASSERT_EQ(track->size(), 2U);
  for (int k = 0; k < kLandmarkCount; ++k)
    EXPECT_EQ(track->at(7)[static_cast<std::size_t>(k)], glm::dvec2(x_of(k), y_of(k))) << k;
}

TEST(LandmarkFile, OpenFaceCountsFromOneAndSaysWhereItFailed) {
  const std::string names = header("frame, face_id, timestamp, confidence, success", "_");
  const auto track =
      parse_landmarks(names + row("1, 0, 0.000, 0.98, 1") + row("2, 0, 0.033, 0.98, 0") +
                          row("3, 0, 0.066, 0.3, 1") + row("4, 1, 0.1, 0.98, 1") + row("4, 0, 0.1, 0.98, 1"),
                      kWidth, kHeight);
  ASSERT_TRUE(track) << track.error().text;
  EXPECT_EQ(track->size(), 2U);
  EXPECT_TRUE(track->contains(0));
  EXPECT_TRUE(track->contains(3));
}

TEST(LandmarkFile, ARowWithoutAFaceIsNoError) {
  const auto track = parse_landmarks(
      header("frame,found") + row("0,1") + row("1,0", "nan") + row("2,1", "nan") + row("3,1", ""), kWidth,
      kHeight);
  ASSERT_TRUE(track) << track.error().text;
  EXPECT_EQ(track->size(), 1U);
}

TEST(LandmarkFile, TakesAnyLineEndsAndAByteOrderMark) {
  std::string text = "\xef\xbb\xbf" + header("frame") + row("0") + "\n" + row("1");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  text.resize(text.size() - 2);  // nor does the last line need one
  const auto track = parse_landmarks(text, kWidth, kHeight);
  ASSERT_TRUE(track) << track.error().text;
  EXPECT_EQ(track->size(), 2U);
}

TEST(LandmarkFile, NamesTheLineOfWhatIsWrong) {
  const std::string good = header("frame") + row("0");
  EXPECT_EQ(refusal(""), "empty, not a table of landmarks");
  EXPECT_EQ(refusal("frame,x0,y0\n"), "line 1: no column x1; columns are frame, x0, y0 to x67, y67");
  EXPECT_EQ(refusal(header("time") + row("0")), "line 1: no column frame");
  EXPECT_EQ(refusal(good + "1,2,3\n"), "line 3: 3 fields, the header has 137");
  EXPECT_EQ(refusal(good + row("1", "6o")), "line 3: field 2, \"6o\", is no number");
  EXPECT_EQ(refusal(good + row("1.5")), "line 3: frame \"1.5\" is no number of a picture, counted from 0");
  EXPECT_EQ(refusal(good + row("-1")), "line 3: frame \"-1\" is no number of a picture, counted from 0");
  EXPECT_EQ(refusal(good + row("1") + row("0")), "line 4: the same picture as line 2");
  EXPECT_EQ(refusal(header("frame", "_") + row("0")),
            "line 2: frame \"0\" is no number of a picture, counted from 1");
  EXPECT_EQ(refusal(header("frame") + row("0", "nan")), "no row has a face");
}

TEST(LandmarkFile, RefusesLandmarksThatAreNotPixelsOfThePicture) {
  const std::string text = header("frame") + row("0");
  for (const auto& [width, height] : {std::pair{50, 160}, std::pair{200, 40}}) {
    const auto track = parse_landmarks(text, width, height);
    ASSERT_FALSE(track);
    EXPECT_NE(track.error().text.find("landmarks of another video, or not in pixels"), std::string::npos);
  }
  std::string relative = header("frame") + "0";
  for (int i = 0; i < 2 * kLandmarkCount; ++i) relative += ",0." + std::to_string(100 + i);
  EXPECT_FALSE(parse_landmarks(relative, kWidth, kHeight));
}

}  // namespace
}  // namespace fbs
