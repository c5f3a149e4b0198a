#include "encoder/find/adapt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

glm::dvec2 generic(std::size_t v) {
  const glm::ivec3 p = generic_head().vertices[v].position;
  return glm::dvec2(p.x, p.y);
}

/// Marks on all landmarks of the generic head, moved in its own frame by `change` and seen in `pose`.
template <class Change>
Marks marks_of(const Pose& pose, Change&& change) {
  const PoseProjection projection(pose);
  Marks marks;
  for (std::size_t v = 0; v < kVertexCount; ++v)
    if (generic_head().vertices[v].landmark >= 0)
      marks.vertex[v] = projection(glm::dvec3(change(v, generic(v)), 0));
  return marks;
}

Marks plain_marks(const Pose& pose) {
  return marks_of(pose, [](std::size_t, glm::dvec2 p) { return p; });
}

Pose seen_at(double x, double y, double eye_distance, double roll = 0) {
  Pose pose;
  pose.shift = {x, y};
  pose.log2_scale = std::log2(eye_distance);
  pose.roll = roll;
  return pose;
}

double distance(glm::dvec2 a, glm::dvec2 b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// Largest distance from a mark to its vertex, eye distances.
double worst_mark(const Marks& marks, const AdaptedHead& head) {
  const PoseProjection projection(head.pose);
  double worst = 0;
  for (std::size_t v = 0; v < kVertexCount; ++v)
    if (marks.vertex[v])
      worst = std::max(worst, distance(projection(glm::dvec3(head.geometry.positions[v])), *marks.vertex[v]));
  return worst / head.pose.eye_distance_px();
}

int folded_triangles(const Geometry& geometry) {
  int folded = 0;
  for (const HeadTriangle& t : generic_head().triangles) {
    const auto at = [&](std::size_t i) { return glm::ivec2(geometry.positions[t[i]]); };
    const glm::ivec2 a = at(1) - at(0), b = at(2) - at(0);
    if (std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x <= 0) ++folded;
  }
  return folded;
}

TEST(AdaptHead, MarksOfTheGenericHeadGiveItBack) {
  const auto head = adapt_head(plain_marks(seen_at(100, 80, 40)));
  ASSERT_TRUE(head);
  EXPECT_LT(worst_mark(plain_marks(seen_at(100, 80, 40)), *head), 1.0 / 256);
  for (std::size_t v = 0; v < kVertexCount; ++v)
    EXPECT_LT(distance(generic(v), glm::dvec2(glm::ivec2(head->geometry.positions[v]))), 0.02 * 4096) << v;
}

TEST(AdaptHead, RecoversScaleRollAndPlace) {
  for (const double eye : {8.0, 40.0, 300.0}) {
    for (const double roll : {-0.5, 0.0, 0.3}) {
      const auto head = adapt_head(plain_marks(seen_at(231, 117, eye, roll)));
      ASSERT_TRUE(head);
      EXPECT_NEAR(head->pose.roll, roll, 1e-6);
      EXPECT_NEAR(head->pose.eye_distance_px() / eye, 1, 0.02);
      EXPECT_LT(distance(head->pose.shift, {231, 117}), 0.03 * eye);
      EXPECT_EQ(head->pose.pitch, 0);
      EXPECT_NEAR(head->pose.yaw, 0, 1e-9);
    }
  }
}

TEST(AdaptHead, RecoversTheTurnThatMarksShow) {
  for (const double yaw : {-0.3, -0.1, 0.2}) {
    Pose turned = seen_at(160, 120, 50, 0.1);
    turned.yaw = yaw;
    const PoseProjection projection(turned);
    Marks marks;
    for (std::size_t v = 0; v < kVertexCount; ++v)
      if (generic_head().vertices[v].landmark >= 0)
        marks.vertex[v] = projection(glm::dvec3(generic_head().vertices[v].position));
    const auto head = adapt_head(marks);
    ASSERT_TRUE(head);
    EXPECT_NEAR(head->pose.yaw, yaw, 0.03);
    EXPECT_NEAR(head->pose.eye_distance_px() / 50, 1, 0.03);
    EXPECT_LT(worst_mark(marks, *head), 0.01);
    EXPECT_EQ(folded_triangles(head->geometry), 0);
  }
}

/// Another face: every feature as a whole moved and stretched by up to a tenth of the eye distance.
Marks other_face(unsigned seed, const Pose& pose) {
  std::mt19937 random(seed);
  const auto within = [&](double a) { return std::uniform_real_distribution<double>(-a, a)(random); };
  const glm::dvec2 wide(1 + within(0.15), 1 + within(0.2));
  const auto offset = [&] { return glm::dvec2(within(0.03), within(0.1)) * 4096.0; };
  const glm::dvec2 jaw(0, within(0.1) * 4096), brow = offset(), nose = offset(), mouth = offset();
  return marks_of(pose, [&](std::size_t v, glm::dvec2 p) {
    const int k = generic_head().vertices[v].landmark;
    const double below = std::max(0.0, p.y / (1.8 * 4096));
    return p * wide + (k < 17 ? jaw * below : k < 27 ? brow : k < 36 ? nose : k < 48 ? glm::dvec2(0) : mouth);
  });
}

TEST(AdaptHead, ReachesMarksOfAnotherFace) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Marks marks = other_face(seed, seen_at(160, 120, 50, 0.1));
    const auto head = adapt_head(marks);
    ASSERT_TRUE(head);
    EXPECT_LT(worst_mark(marks, *head), 1.0 / 400) << "eye distances, seed " << seed;
    EXPECT_EQ(folded_triangles(head->geometry), 0);
    EXPECT_LE(head->iterations, 60);
  }
}

TEST(AdaptHead, ReachesTheTalkersPoints) {
  const TalkerClip clip(talker_settings(176, 144, 1));
  const auto head = adapt_head(clip.marks(0));
  ASSERT_TRUE(head);
  EXPECT_LT(worst_mark(clip.marks(0), *head), 0.01);
  EXPECT_EQ(folded_triangles(head->geometry), 0);
}

// Vertices without marks of their own go along with their neighbours.
TEST(AdaptHead, SpreadsAMarksForceOverItsNeighbourhood) {
  const auto mouth = vertex_of_landmark(57);  // middle of the lower lip
  const Marks marks = marks_of(seen_at(100, 80, 40), [&](std::size_t v, glm::dvec2 p) {
    return p +
           glm::dvec2(0, generic_head().vertices[v].landmark >= 48 && p.y > generic(mouth).y - 600 ? 400 : 0);
  });
  Marks eyes_and_lip;
  for (int k = 36; k < 60; ++k)
    if (const auto p = marks.landmark(k)) eyes_and_lip.set_landmark(k, *p);
  const auto head = adapt_head(eyes_and_lip), still = adapt_head(plain_marks(seen_at(100, 80, 40)));
  ASSERT_TRUE(head && still);
  const auto moved = [&](int ibug) {
    const auto v = vertex_of_landmark(ibug);
    return head->geometry.positions[v].y - still->geometry.positions[v].y;
  };
  EXPECT_GT(moved(8), 40) << "the chin, unmarked, follows";
  EXPECT_NEAR(moved(37), 0, 60) << "a marked eye does not";
}

// A hand that slips, a detector gone wild: whatever the marks say, no triangle turns over.
TEST(AdaptHead, AbsurdMarksFoldNoTriangle) {
  std::mt19937 random(2);
  for (int i = 0; i < 60; ++i) {
    std::uniform_real_distribution<double> x(0, 352), y(0, 288);
    Marks marks = plain_marks(seen_at(170, 120, 60));
    switch (i % 3) {
      case 0:  // anywhere at all, eyes included
        for (auto& m : marks.vertex)
          if (m) m = glm::dvec2(x(random), y(random));
        break;
      case 1:  // right places, wrong owners
        std::shuffle(marks.vertex.begin(), marks.vertex.end(), random);
        break;
      default:  // one mark far away
        marks.set_landmark(static_cast<int>(random() % kLandmarkCount), {x(random) * 20, y(random) * -20});
        break;
    }
    const auto head = adapt_head(marks);
    if (!head) {
      EXPECT_EQ(head.error().code, ErrorCode::kDegenerateInput);
      continue;
    }
    EXPECT_EQ(folded_triangles(head->geometry), 0) << i;
    EXPECT_LE(head->iterations, 60);
  }
}

TEST(AdaptHead, RefusesMarksThatAreNoPositions) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity(), 1e9, -1e9})
    for (const int landmark : {8, 36}) {  // chin, an eye
      Marks marks = plain_marks(seen_at(100, 80, 40));
      marks.set_landmark(landmark, {100, bad});
      const auto head = adapt_head(marks);
      ASSERT_FALSE(head) << bad;
      EXPECT_EQ(head.error().code, ErrorCode::kDegenerateInput);
    }
}

TEST(AdaptHead, RefusesMarksWithoutAnEye) {
  Marks marks = plain_marks(seen_at(100, 80, 40));
  for (int k = 36; k < 42; ++k) marks.vertex[vertex_of_landmark(k)].reset();
  EXPECT_EQ(adapt_head(marks).error().code, ErrorCode::kDegenerateInput);
  EXPECT_EQ(adapt_head(plain_marks(seen_at(100, 80, 3))).error().code, ErrorCode::kDegenerateInput);
}

TEST(AdaptHead, TwoEyesAreEnough) {
  Marks marks;
  marks.set_landmark(36, {80, 60});
  marks.set_landmark(39, {90, 60});
  marks.set_landmark(42, {110, 60});
  marks.set_landmark(45, {120, 60});
  const auto head = adapt_head(marks);
  ASSERT_TRUE(head);
  EXPECT_NEAR(head->pose.eye_distance_px(), 30, 1e-9);
  EXPECT_EQ(folded_triangles(head->geometry), 0);
}

}  // namespace
}  // namespace fbs
