// The generated talker: its pictures repeat, its truth is what it says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>
#include <string>

#include "samples/talker/talker_files.h"
#include "samples/talker/talker_options.h"
#include "samples/talker/talker_render.h"

namespace fbs::talker {
namespace {

Settings small() {
  Settings settings;
  settings.width = 96;
  settings.height = 80;
  settings.frame_count = 120;
  return settings;
}

/// The frame with the most open mouth.
int most_open(const Talker& talker) {
  int best = 0;
  for (int i = 0; i < talker.settings().frame_count; ++i) {
    if (talker.truth(i).expression.mouth_open > talker.truth(best).expression.mouth_open) best = i;
  }
  return best;
}

double difference(const Plane& a, const Plane& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) sum += std::abs(a.samples[i] - b.samples[i]);
  return sum / static_cast<double>(a.samples.size());
}

TEST(Talker, SameSettingsGiveTheSameBytes) {
  Settings settings = small();
  settings.noise = 2;
  EXPECT_EQ(Talker(settings).picture(7), Talker(settings).picture(7));
  settings.seed = 2;
  EXPECT_NE(Talker(settings).picture(7), Talker(small()).picture(7));
}

TEST(Talker, StartsFrontalAndNeutral) {
  for (const Motion motion :
       {Motion::kDefault, Motion::kTurns, Motion::kTalk, Motion::kBrows, Motion::kBlink, Motion::kLong}) {
    Settings settings = small();
    settings.motion = motion;
    const Moment start = Talker(settings).truth(0);
    EXPECT_EQ(start.pose.pitch_deg, 0);
    EXPECT_EQ(start.pose.yaw_deg, 0);
    EXPECT_EQ(start.pose.roll_deg, 0);
    EXPECT_NEAR(start.pose.scale_px, settings.eye_distance * 80, 1e-4);
    EXPECT_EQ(start.expression.mouth_open, 0);
    EXPECT_EQ(start.expression.brow_left, 0);
    EXPECT_NEAR(start.expression.eye_open_right, kEyeOpenNeutral, 1e-6);
    EXPECT_NEAR(start.expression.eye_open_left, kEyeOpenNeutral, 1e-6);
  }
}

TEST(Talker, EyeCentresOfFrameZeroAreOneEyeDistanceApart) {
  const Talker talker(small());
  const auto p = talker.points(0);
  const glm::vec2 right = 0.5f * (p[36] + p[39]), left = 0.5f * (p[42] + p[45]);
  EXPECT_NEAR(left.x - right.x, talker.truth(0).pose.scale_px, 0.01);
  EXPECT_NEAR(left.y, right.y, 0.01);
}

TEST(Talker, LandmarksStayInsideThePicture) {
  const Talker talker(small());
  for (int i = 0; i < talker.settings().frame_count; ++i) {
    for (const glm::vec2 p : talker.points(i)) {
      EXPECT_TRUE(p.x >= 0 && p.x <= 95 && p.y >= 0 && p.y <= 79)
          << "frame " << i << ": " << p.x << ' ' << p.y;
    }
  }
}

TEST(Talker, LandmarksLieOnTheMovedSurface) {
  Expression e = neutral();
  e.mouth_open = 0.25f;
  e.mouth_wide = -0.08f;
  e.mouth_round = 0.08f;
  e.brow_left = 0.1f;
  const auto points = landmarks(e);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(skull_distance(rest_of(points[i], e)), 0, 0.01) << "point " << i;
  }
}

TEST(Talker, MovedIsTheInverseOfRestOf) {
  Expression e = neutral();
  e.mouth_open = 0.3f;
  e.mouth_wide = 0.06f;
  e.brow_right = 0.13f;
  for (const glm::vec3 q :
       {glm::vec3(0, 1.6f, -1.2f), glm::vec3(-0.5f, -0.4f, -1.2f), glm::vec3(0.4f, 1.0f, -1.1f)}) {
    EXPECT_LT(glm::length(rest_of(moved(q, e), e) - q), 1e-3f);
  }
}

TEST(Talker, OpenMouthHasAWideLipGapAndADarkInside) {
  const Talker talker(small());
  const int open = most_open(talker);
  const Moment moment = talker.truth(open);
  const auto closed_points = talker.points(0), open_points = talker.points(open);
  EXPECT_LT(glm::length(closed_points[66] - closed_points[62]), 0.05f);
  EXPECT_NEAR(glm::length(open_points[66] - open_points[62]),
              moment.expression.mouth_open * moment.pose.scale_px,
              0.15f * moment.expression.mouth_open * moment.pose.scale_px);
  EXPECT_GT(moment.expression.mouth_open, 0.15f);
}

TEST(Talker, ShutLidsMeet) {
  Expression e = neutral();
  e.eye_open_right = 0;
  const auto p = landmarks(e);
  EXPECT_LT(std::abs(p[37].y - p[41].y), 1e-3f);
  EXPECT_GT(p[47].y - p[43].y, 0.1f);
}

TEST(Talker, PoseStaysWithinItsAmplitudes) {
  Settings settings = small();
  settings.frame_count = 3000;
  const Talker talker(settings);
  float widest = 0;
  for (int i = 0; i < settings.frame_count; ++i) {
    const Pose pose = talker.truth(i).pose;
    EXPECT_LE(std::abs(pose.yaw_deg), settings.yaw_deg);
    EXPECT_LE(std::abs(pose.pitch_deg), settings.pitch_deg);
    EXPECT_LE(std::abs(pose.roll_deg), settings.roll_deg);
    widest = std::max(widest, std::abs(pose.yaw_deg));
  }
  EXPECT_GT(widest, 0.7f * settings.yaw_deg);
}

TEST(Talker, SignsOfRotationAreThoseOfTheDocumentation) {
  const glm::vec3 nose{0, 0, -1}, left_eye{1, 0, 0};
  EXPECT_LT(project({.yaw_deg = 10}, nose).x, 0);       // turns to the left of the picture
  EXPECT_GT(project({.pitch_deg = 10}, nose).y, 0);     // looks down
  EXPECT_GT(project({.roll_deg = 10}, left_eye).y, 0);  // clockwise
}

TEST(Talker, StillHoldsThePose) {
  Settings settings = small();
  settings.still = true;
  const Talker talker(settings);
  const Pose first = talker.truth(0).pose, later = talker.truth(60).pose;
  EXPECT_EQ(later.yaw_deg, 0);
  EXPECT_EQ(later.shift_px, first.shift_px);
  EXPECT_EQ(later.scale_px, first.scale_px);
  EXPECT_GT(talker.truth(most_open(talker)).expression.mouth_open, 0);
}

TEST(Talker, LongEndsWhereItBegan) {
  Settings settings = small();
  settings.motion = Motion::kLong;
  const Talker talker(settings);
  EXPECT_EQ(talker.picture(0), talker.picture(settings.frame_count - 1));
  EXPECT_EQ(talker.points(3), talker.points(settings.frame_count - 4));
}

TEST(Talker, MovesThePictureAndNotTheBackground) {
  const Talker talker(small());
  const Picture first = talker.picture(0), later = talker.picture(45);
  EXPECT_GT(difference(first.y, later.y), 0.5);
  for (int y = 0; y < 8; ++y) EXPECT_EQ(first.y.row(y)[2], later.y.row(y)[2]);
}

TEST(TalkerFiles, Y4mHasHeaderAndWholeFrames) {
  Settings settings = small();
  settings.width = 97;  // odd sizes round chroma up
  settings.frame_rate = {30000, 1001};
  std::ostringstream out;
  write_y4m_header(out, settings);
  const std::string header = out.str();
  EXPECT_TRUE(header.starts_with("YUV4MPEG2 W97 H80 F30000:1001 Ip A1:1 C420jpeg")) << header;
  EXPECT_TRUE(header.ends_with("\n"));
  write_y4m_frame(out, Talker(settings).picture(0));
  EXPECT_EQ(out.str().size(), header.size() + 6 + 97 * 80 + 2 * 49 * 40);
}

TEST(TalkerFiles, TruthHasAValueForEachColumn) {
  std::ostringstream header, line;
  write_truth_header(header);
  write_truth_line(line, Talker(small()), 5);
  EXPECT_TRUE(header.str().starts_with("frame,rx_deg,ry_deg,rz_deg,tx_px,ty_px,scale,x0,y0,x1,y1,"));
  EXPECT_TRUE(line.str().starts_with("5,"));
  const auto commas = [](const std::string& s) { return std::ranges::count(s, ','); };
  EXPECT_EQ(commas(header.str()), commas(line.str()));
}

TEST(TalkerOptions, ReadsAndRefuses) {
  std::string complaint;
  std::string video = "-", fps = "--fps", rate = "30000/1001", motion = "--motion", turns = "turns",
              bad = "waltz";
  char* good[] = {video.data(), fps.data(), rate.data(), motion.data(), turns.data()};
  const auto options = parse_options(good, complaint);
  ASSERT_TRUE(options.has_value()) << complaint;
  EXPECT_EQ(options->settings.frame_rate, (Rational{30000, 1001}));
  EXPECT_EQ(options->settings.motion, Motion::kTurns);
  char* wrong[] = {video.data(), motion.data(), bad.data()};
  EXPECT_FALSE(parse_options(wrong, complaint).has_value());
  EXPECT_FALSE(complaint.empty());
}

}  // namespace
}  // namespace fbs::talker
