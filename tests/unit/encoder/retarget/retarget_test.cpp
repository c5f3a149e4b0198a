#include "encoder/retarget/retarget.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>

#include "decoder/scene/scene_face.h"
#include "tests/unit/encode_decode.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

std::vector<std::uint8_t> vector_file(const std::string& name) {
  std::ifstream file(std::filesystem::path(FBS_VECTORS) / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

FaceStream face(const std::string& name) {
  auto read = read_face_stream(vector_file(name));
  if (!read) throw std::runtime_error(read.error().text);
  return std::move(*read);
}

/// The head nods.
MotionRecord nodding(int pictures) {
  MotionRecord motion;
  motion.frame_rate = {25, 1};
  motion.parts = kAllParts;
  motion.rest = toy_state();
  motion.geometries = {toy_geometry()};
  for (int t = 0; t < pictures; ++t) {
    State state = motion.rest;
    state.pose[kPitch] += 40 * (t % 10);
    motion.pictures.push_back({state, 3600, 0});
  }
  return motion;
}

/// Decodes a stream that must be free of errors.
template <class See>
void decode(const std::vector<std::uint8_t>& stream, See&& see) {
  const auto end = decode_pictures(stream, see);
  ASSERT_TRUE(end) << end.error().text;
}

TEST(ReadFaceStream, TakesThePatternsAndTheirStates) {
  const FaceStream read = face("patterns.fbs");
  EXPECT_EQ(read.later.size(), 5U);
  std::size_t patterns = 0;
  decode(vector_file("patterns.fbs"), [&](const StreamDecoder& decoder) {
    const Scene& scene = decoder.scene();
    patterns = scene.patterns.size();
    for (std::size_t k = 1; k < patterns; ++k)
      EXPECT_EQ(scene.patterns[k].seen.control, read.later[k - 1].seen.control);
    EXPECT_EQ(scene.geometry->geometry(), read.geometry);
    EXPECT_EQ(scene.patterns.front().seen.pose, read.rest.pose);
  });
  EXPECT_EQ(patterns, 6U);
}

TEST(ReadFaceStream, FindsTheSceneWithAFace) {
  EXPECT_FALSE(face("late.fbs").geometry_payload.empty());
  const auto nobody = read_face_stream(vector_file("nobody.fbs"));
  ASSERT_FALSE(nobody);
  EXPECT_EQ(nobody.error().code, ErrorCode::kDegenerateInput);
}

TEST(ReadFaceStream, LeavesOutPatternsThatReplaceOthers) {
  EXPECT_EQ(face("blends.fbs").later.size(), 2U);
}

TEST(ReadFaceStream, FailsWhereTheStreamIsDamaged) {
  for (const char* name : {"truncated.fbs", "flipped_bits.fbs", "not_fbs.fbs", "newer.fbs", "lost_key.fbs"})
    EXPECT_FALSE(read_face_stream(vector_file(name))) << name;
}

TEST(ReadMotionRecord, HoldsTheFirstStateWhereNoFaceIsSeenYet) {
  const auto record = read_motion_record(vector_file("late.fbs"));
  ASSERT_TRUE(record);
  EXPECT_EQ(record->pictures.front().state.pose, record->rest.pose);
  EXPECT_FALSE(read_motion_record(vector_file("nobody.fbs")));
  EXPECT_FALSE(read_motion_record(vector_file("truncated.fbs")));
}

TEST(Retarget, HasThePicturesOfTheMotionAndTheSizeOfTheFace) {
  const FaceStream shown = face("patterns.fbs");
  MotionRecord motion = nodding(300);  // more than a group
  motion.pictures[7].duration = 9000;
  const auto stream = retarget(motion, shown);
  ASSERT_TRUE(stream) << stream.error().text;
  std::size_t t = 0;
  decode(*stream, [&](StreamDecoder& decoder) {
    EXPECT_EQ(decoder.format().width, shown.setup.format.width);
    EXPECT_EQ(decoder.duration(), t == 7 ? 9000U : 3600U);
    EXPECT_NEAR(decoder.state().pose[kPitch], shown.rest.pose[kPitch] + 40 * (static_cast<int>(t) % 10), 64)
        << t;
    EXPECT_EQ(decoder.scene().patterns.size(), 6U);
    ++t;
  });
  EXPECT_EQ(t, 300U);
}

TEST(Retarget, PatternsKeepTheirStates) {
  const FaceStream shown = face("patterns.fbs");
  const auto stream = retarget(nodding(20), shown);
  ASSERT_TRUE(stream);
  decode(*stream, [&](const StreamDecoder& decoder) {
    for (std::size_t k = 0; k < shown.later.size(); ++k) {
      const State &kept = decoder.scene().patterns[k + 1].seen, &seen = shown.later[k].seen;
      for (std::size_t i = 0; i < kPoseCount; ++i)
        EXPECT_NEAR(kept.pose[i], seen.pose[i], 32) << k << ' ' << i;
      for (std::size_t c = 0; c < kControlCount; ++c)
        EXPECT_LT(glm::length(glm::dvec2(kept.control[c] - seen.control[c])), 60) << k << ' ' << c;
    }
    EXPECT_EQ(decoder.scene().patterns.front().seen.pose, shown.rest.pose);
  });
}

TEST(Retarget, BeginsAnotherSceneWhereTooManyPicturesWouldWait) {
  const auto stream = retarget(nodding(kMaxWaitingPictures + 100), face("patterns.fbs"));
  ASSERT_TRUE(stream) << stream.error().text;
  int pictures = 0;
  decode(*stream, [&](const StreamDecoder&) { ++pictures; });
  EXPECT_EQ(pictures, kMaxWaitingPictures + 100);
}

TEST(Retarget, OnePatternIsNotBlended) {
  const auto stream = retarget(nodding(20), face("talk.fbs"));
  ASSERT_TRUE(stream);
  Picture first, nods;
  decode(*stream, [&](StreamDecoder& decoder) {
    EXPECT_EQ(decoder.scene().setup.patterns, 1);
    ASSERT_TRUE(decoder.render(decoder.pictures() == 1 ? first : nods));
  });
  EXPECT_NE(first.y.samples, nods.y.samples);
}

}  // namespace
}  // namespace fbs
