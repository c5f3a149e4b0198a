#include "encoder/retarget/motion_transfer.h"

#include <gtest/gtest.h>

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kTouching = kUnitsPerEyeDistance / 100;

/// A motion of one picture, which is at rest, and a face: both the generic head, eyes 32 pixels apart.
struct People {
  MotionRecord motion;
  FaceStream face;

  People() {
    motion.rest = toy_state();
    motion.geometries = {toy_geometry()};
    motion.pictures = {{motion.rest, 3600, 0}};
    face.geometry = toy_geometry();
    face.rest = toy_state();
  }

  State& moves() { return motion.pictures.front().state; }

  /// The face's numbers in the motion's picture.
  [[nodiscard]] StateNumbers numbers() const { return MotionTransfer(motion, face)(motion.pictures.front()); }

  [[nodiscard]] std::vector<glm::ivec3> shown() const {
    const StateNumbers numbers = this->numbers();
    CodedState rounded{};
    for (std::size_t i = 0; i < numbers.size(); ++i)
      rounded[i] = static_cast<std::int32_t>(std::lround(numbers[i]));
    return deform(face.geometry, state_of_values(rounded));
  }
};

void move_feature(State& state, FeatureId id, glm::ivec2 by) {
  const Feature& f = feature(id);
  for (int c = 0; c < f.control_count; ++c) state.control[f.first_control + c] += by;
}

/// Moves landmarks of a geometry.
void move_landmarks(Geometry& geometry, int first, int last, glm::ivec3 by) {
  for (int k = first; k <= last; ++k) geometry.positions[vertex_of_landmark(k)] += by;
}

int height(const std::vector<glm::ivec3>& vertices, int upper, int lower) {
  return vertices[vertex_of_landmark(lower)].y - vertices[vertex_of_landmark(upper)].y;
}

/// The lower lip goes down.
void open_mouth(State& state, int by) {
  for (const auto& [id, first, last] :
       {std::tuple{FeatureId::kMouthOuter, 6, 9}, {FeatureId::kMouthInner, 5, 7}})
    for (int c = first; c <= last; ++c) state.control[feature(id).first_control + c].y += by;
}

TEST(MotionTransfer, RestIsRest) {
  People people;
  people.face.rest.pose = {300, -200, 100, 70 * 64, 60 * 64, 6 * 4096};
  people.face.rest.light[kLightOffset] = 33;
  const StateNumbers numbers = people.numbers();
  for (std::size_t i = 0; i < kFirstCoefficient; ++i)
    EXPECT_NEAR(numbers[i], numbers_of(people.face.rest)[i], 1e-9) << i;
}

TEST(MotionTransfer, TurnsAsFarFromItsOwnFirstPicture) {
  People people;
  people.motion.rest.pose[kYaw] = 1000;
  people.face.rest.pose[kYaw] = -500;
  people.moves().pose[kYaw] = 1300;
  people.moves().pose[kLogScale] += 123;
  EXPECT_DOUBLE_EQ(people.numbers()[kYaw], -200);
  EXPECT_DOUBLE_EQ(people.numbers()[kLogScale], 5 * 4096 + 123);
}

TEST(MotionTransfer, ShiftsByEyeDistances) {
  People people;
  people.face.rest.pose[kLogScale] += 4096;  // twice as large
  people.moves().pose[kShiftX] += 640;
  people.moves().body[kDisplacementY] = 64;
  const StateNumbers numbers = people.numbers();
  EXPECT_NEAR(numbers[kShiftX], people.face.rest.pose[kShiftX] + 1280, 1e-6);
  EXPECT_NEAR(numbers[first_of(PartId::kBody) + kDisplacementY], 128, 1e-6);
}

TEST(MotionTransfer, LeavesOutWhatTheCameraDid) {
  People people;
  people.moves().pose[kShiftX] += 640;
  people.moves().body[kDisplacementX] = 640;
  people.moves().ground[kDisplacementX] = 640;
  const StateNumbers numbers = people.numbers();
  EXPECT_NEAR(numbers[kShiftX], people.face.rest.pose[kShiftX], 1e-6);
  for (std::size_t i = first_of(PartId::kBody); i < first_of(PartId::kMouth); ++i)
    EXPECT_NEAR(numbers[i], 0, 1e-6);
}

TEST(MotionTransfer, LightAndMouthAreTheFaces) {
  People people;
  people.face.rest.light[kLightGain] = 77;
  people.face.interior = {10, -20, 30};
  people.moves().light.fill(500);
  people.moves().interior.fill(500);
  const StateNumbers numbers = people.numbers();
  EXPECT_EQ(numbers[first_of(PartId::kLight) + kLightGain], 77);
  EXPECT_EQ(numbers[first_of(PartId::kLight)], 0);
  EXPECT_EQ(numbers[first_of(PartId::kMouthInterior) + kInteriorMiddle], -20);
}

TEST(MotionTransfer, AShutEyeIsShutThoughItIsLarger) {
  People people;
  for (const int k : {40, 41}) move_landmarks(people.face.geometry, k, k, {0, 150, 0});
  const int open = height(people.motion.geometries[0].positions, 37, 41);
  ASSERT_GT(height(people.face.geometry.positions, 37, 41), open + 100);
  // The lid comes down by as much as the eye is open, which is also what shuts it.
  State& moves = people.moves();
  move_feature(moves, FeatureId::kUpperLidRight, {0, 1000});
  const int left = height(deform(people.motion.geometries[0], moves), 37, 41);
  move_feature(moves, FeatureId::kUpperLidRight, {0, 1000 * left / std::max(1, open - left)});
  ASSERT_NEAR(height(deform(people.motion.geometries[0], moves), 37, 41), 0, 10);
  EXPECT_NEAR(height(people.shown(), 37, 41), 0, kTouching);
}

TEST(MotionTransfer, AShutMouthIsShutThoughTheFaceWasSeenOpen) {
  People people;
  move_landmarks(people.face.geometry, 65, 67, {0, 200, 0});
  ASSERT_GT(mouth_gap(people.face.geometry, {}), 200);
  const auto shown = people.shown();
  for (const auto& [upper, lower] : {std::pair{61, 67}, {62, 66}, {63, 65}})
    EXPECT_NEAR(height(shown, upper, lower), 0, kTouching) << upper;
}

TEST(MotionTransfer, AShutMouthStaysShutHoweverItIsMoved) {
  People people;
  for (int i = 0; i < kControlCount; ++i)
    people.moves().control[i] = {i * 37 % 200 - 100, i * 53 % 200 - 100};
  // Among open pictures, this one is shut.
  State open = people.motion.rest;
  open_mouth(open, 800);
  const int gap = mouth_gap(people.motion.geometries[0], people.moves());
  ASSERT_LT(gap, kUnitsPerEyeDistance / 20);
  for (int i = 0; i < 8; ++i) people.motion.pictures.push_back({open, 3600, 0});
  EXPECT_NEAR(height(people.shown(), 62, 66), 0, kTouching);
}

TEST(MotionTransfer, AMouthOpensByTheFacesOwnSize) {
  People people;
  // Mouth to chin is half as long again.
  const int chin = people.face.geometry.positions[vertex_of_landmark(8)].y;
  const int mouth = people.face.geometry.positions[vertex_of_landmark(62)].y;
  move_landmarks(people.face.geometry, 8, 8, {0, (chin - mouth) / 2, 0});
  people.motion.pictures.assign(9, people.motion.pictures.front());
  open_mouth(people.moves(), 800);
  const int opened = mouth_gap(people.motion.geometries[0], people.moves());
  ASSERT_GT(opened, 500);
  EXPECT_NEAR(mouth_gap(generic_head(), people.shown()), 1.5 * opened, 0.1 * opened);
}

TEST(MotionTransfer, BrowsRiseByTheFacesOwnSize) {
  People people;
  move_landmarks(people.face.geometry, 17, 21, {0, -400, 0});
  move_feature(people.moves(), FeatureId::kBrowRight, {0, -200});
  const auto before = people.face.geometry.positions[vertex_of_landmark(19)].y;
  const auto rise = before - people.shown()[vertex_of_landmark(19)].y;
  const auto plain = people.motion.geometries[0].positions[vertex_of_landmark(19)].y -
                     deform(people.motion.geometries[0], people.moves())[vertex_of_landmark(19)].y;
  EXPECT_GT(rise, 1.1 * plain);
}

}  // namespace
}  // namespace fbs
