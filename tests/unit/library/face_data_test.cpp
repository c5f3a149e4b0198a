#include "library/face_data.h"

#include <cmath>
#include <set>
#include <vector>

#include "common/ibug.h"
#include "decoder/scene/scene_face.h"
#include "decoder/stream/stream_decoder.h"
#include "tests/unit/library/api_decoder.h"
#include "tests/unit/split_head.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

using Landmarks = std::array<fbs_landmark, kLandmarkCount>;

/// Landmarks of the generic head, turned by this many degrees.
Landmarks turned(double yaw_degrees) {
  const Scene scene = toy_scene(noise_picture(160, 128, 1));
  State state = toy_state();
  state.pose[kYaw] = static_cast<std::int32_t>(yaw_degrees * 65536 / 360);
  Landmarks out;
  write_landmarks(*scene.geometry, state, out);
  return out;
}

TEST(FaceData, StateIsInPixelsDegreesAndEyeDistances) {
  State state = toy_state(80, 50);
  state.pose[kPitch] = 65536 / 36;
  state.pose[kYaw] = -65536 / 18;
  state.pose[kRoll] = 65536 / 8;
  state.control[3] = {kUnitsPerEyeDistance / 2, -kUnitsPerEyeDistance};
  const fbs_face_state face = face_state(state);
  EXPECT_NEAR(face.pitch, 10, 0.01);
  EXPECT_NEAR(face.yaw, -20, 0.01);
  EXPECT_NEAR(face.roll, 45, 0.01);
  EXPECT_EQ(face.x, 80);
  EXPECT_EQ(face.y, 50);
  EXPECT_EQ(face.eye_distance, 32);
  EXPECT_EQ(face.control[3][0], 0.5F);
  EXPECT_EQ(face.control[3][1], -1);
}

TEST(FaceData, AStateComesBackAsItWas) {
  State state = toy_state(80, 50);
  state.blend.fill(BlendMode::kStillBefore);
  std::int32_t value = -kMaxControl;
  for (glm::ivec2& c : state.control) {
    c = {value, -value};
    value += 97;
  }
  for (const std::int32_t turn : {-kMaxRotation, -1, 0, 4321, kMaxRotation})
    for (const std::int32_t scale : {0, 1, 20481, kMaxLogScale}) {
      state.pose = {turn, -turn, turn / 2, 3 * turn, -turn, scale};
      EXPECT_EQ(state_of(face_state(state), state), state) << turn << ' ' << scale;
    }
}

TEST(FaceData, AnotherStateSetsTheHeadInMotion) {
  State sent = toy_state(80, 50);
  sent.blend.fill(BlendMode::kStillBefore);
  fbs_face_state face = face_state(sent);
  face.yaw += 5;
  const auto state = state_of(face, sent);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->pose[kYaw], sent.pose[kYaw] + 910);
  EXPECT_EQ(state->blend[static_cast<std::size_t>(Region::kMouth)], BlendMode::kByState);
  EXPECT_EQ(state->blend[static_cast<std::size_t>(Region::kGround)], BlendMode::kStillBefore);
}

TEST(FaceData, StatesBeyondTheFormatAreNone) {
  const State sent = toy_state(80, 50);
  const fbs_face_state good = face_state(sent);
  const auto refused = [&](auto&& change) {
    fbs_face_state face = good;
    change(face);
    return !state_of(face, sent);
  };
  for (const float bad : {NAN, INFINITY, -INFINITY, 1e9F}) {
    EXPECT_TRUE(refused([&](fbs_face_state& f) { f.pitch = bad; })) << bad;
    EXPECT_TRUE(refused([&](fbs_face_state& f) { f.y = bad; })) << bad;
    EXPECT_TRUE(refused([&](fbs_face_state& f) { f.eye_distance = bad; })) << bad;
    EXPECT_TRUE(refused([&](fbs_face_state& f) { f.control[FBS_CONTROL_POINTS - 1][1] = bad; })) << bad;
  }
  EXPECT_TRUE(refused([](fbs_face_state& f) { f.roll = 90.1F; }));
  EXPECT_TRUE(refused([](fbs_face_state& f) { f.eye_distance = 0.9F; }));
}

TEST(FaceData, EditsStopAtTheLimitsOfTheHeader) {
  const auto edit = edit_of({100, -100, 5, 2, -2, 0.5F, 0});
  ASSERT_TRUE(edit);
  EXPECT_EQ(edit->value(EditPart::kPitch), 12 * 65536 / 360);
  EXPECT_EQ(edit->value(EditPart::kYaw), -(18 * 65536 / 360));
  EXPECT_EQ(edit->value(EditPart::kRoll), std::lround(5 * 65536 / 360.0));
  EXPECT_EQ(edit->value(EditPart::kBrows), StateEdit::limits(EditPart::kBrows).high);
  EXPECT_EQ(edit->value(EditPart::kMouth), StateEdit::limits(EditPart::kMouth).low);
  EXPECT_EQ(edit->value(EditPart::kSmile), StateEdit::limits(EditPart::kSmile).high / 2);
  EXPECT_EQ(edit->value(EditPart::kLids), 0);
  EXPECT_FALSE(edit_of({0, 0, 0, 0, 0, 0, NAN}));
}

TEST(FaceData, SignsAreThoseOfTheHeader) {
  const auto left = turned(20), frontal = turned(0);
  const auto tip = static_cast<std::size_t>(ibug::kNoseTip);
  EXPECT_LT(left[tip].x, frontal[tip].x - 5) << "positive yaw: the face looks to the picture's left";
  EXPECT_LT(frontal[36].x, frontal[45].x) << "the person's right eye is on the picture's left";
}

TEST(FaceData, AFrontalFaceIsSeenEntirely) {
  for (const fbs_landmark& point : turned(0)) EXPECT_EQ(point.confidence, 1);
}

// The far cheek and the far corner of the mouth go first.
TEST(FaceData, ConfidenceFallsOnTheFarSide) {
  const Landmarks profile = turned(85), half = turned(45);
  for (std::size_t k = 0; k < kLandmarkCount; ++k) {
    EXPECT_GE(profile[k].confidence, 0);
    EXPECT_LE(profile[k].confidence, 1);
  }
  EXPECT_LT(profile[0].confidence, 0.1F) << "the ear that is turned away";
  EXPECT_GT(profile[16].confidence, 0.9F);
  EXPECT_LT(half[0].confidence, 0.5F);
  EXPECT_GT(half[ibug::kNoseTip].confidence, 0.5F);
  const Landmarks mirrored = turned(-85);
  EXPECT_NEAR(mirrored[16].confidence, profile[0].confidence, 0.05);
}

TEST(FaceData, IsThatOfTheShownPicture) {
  const auto bytes = vector_bytes("turns.fbs");
  StreamDecoder plain;
  plain.feed(bytes);
  const ApiDecoder decoder = api_decoder();
  ASSERT_EQ(fbs_decoder_feed(decoder.get(), bytes.data(), bytes.size()), FBS_OK);
  int pictures = 0;
  for (; fbs_decoder_next(decoder.get(), nullptr) == FBS_OK; ++pictures) {
    ASSERT_EQ(*plain.next(), DecodeStatus::kPicture);
    const auto expected = face_of(plain.scene())->project_vertices(plain.state());
    fbs_landmark landmarks[FBS_LANDMARKS];
    fbs_vertex vertices[FBS_MAX_VERTICES];
    size_t count = FBS_MAX_VERTICES;
    ASSERT_EQ(fbs_decoder_get_landmarks(decoder.get(), landmarks), FBS_OK);
    ASSERT_EQ(fbs_decoder_get_vertices(decoder.get(), vertices, &count), FBS_OK);
    for (std::size_t k = 0; k < kLandmarkCount; ++k) {
      const std::size_t v = vertex_of_landmark(k);
      EXPECT_EQ(landmarks[k].x, static_cast<float>(expected[v].x) / 64);
      EXPECT_EQ(landmarks[k].y, vertices[v].y);
      EXPECT_EQ(vertices[v].z, static_cast<float>(expected[v].z) / 4096);
    }
  }
  EXPECT_EQ(pictures, 24);
}

TEST(FaceData, HasTheVerticesOfTheScenesOwnWireFrame) {
  const ApiDecoder decoder = at_first_picture("two_heads.fbs");
  StreamDecoder plain;
  plain.feed(vector_bytes("two_heads.fbs"));
  plain.close();
  std::set<std::size_t> counts;
  do {
    ASSERT_EQ(*plain.next(), DecodeStatus::kPicture);
    const auto expected = face_of(plain.scene())->project_vertices(plain.state());
    std::vector<fbs_vertex> vertices(FBS_MAX_VERTICES);
    size_t count = vertices.size();
    ASSERT_EQ(fbs_decoder_get_vertices(decoder.get(), vertices.data(), &count), FBS_OK);
    ASSERT_EQ(count, expected.size());
    EXPECT_EQ(vertices[count - 1].x, static_cast<float>(expected[count - 1].x) / 64);
    counts.insert(count);
  } while (fbs_decoder_next(decoder.get(), nullptr) == FBS_OK);
  EXPECT_EQ(counts, (std::set<std::size_t>{kVertexCount, split_head()->vertices.size()}));
}

TEST(FaceData, WritesNoVerticesWithoutRoomForAll) {
  const ApiDecoder decoder = at_first_picture("one.fbs");
  std::vector<fbs_vertex> vertices(kVertexCount, {-1, -2, -3});
  size_t count = kVertexCount - 1;
  EXPECT_EQ(fbs_decoder_get_vertices(decoder.get(), vertices.data(), &count), FBS_ERROR_ARGUMENT);
  EXPECT_STREQ(fbs_decoder_error(decoder.get()), "there is no room for the vertices");
  EXPECT_EQ(count, std::size_t{kVertexCount});
  for (const fbs_vertex& v : vertices) EXPECT_EQ(v.x, -1);
  EXPECT_EQ(fbs_decoder_get_vertices(decoder.get(), vertices.data(), &count), FBS_OK);
  EXPECT_NE(vertices.back().x, -1);
}

TEST(FaceData, SomeScenesHaveNone) {
  const ApiDecoder decoder = at_first_picture("nobody.fbs");
  fbs_face_state state;
  fbs_landmark landmarks[FBS_LANDMARKS];
  fbs_vertex vertices[FBS_MAX_VERTICES];
  size_t count = FBS_MAX_VERTICES;
  EXPECT_EQ(fbs_decoder_get_state(decoder.get(), &state), FBS_ERROR_NO_FACE);
  EXPECT_EQ(fbs_decoder_get_landmarks(decoder.get(), landmarks), FBS_ERROR_NO_FACE);
  EXPECT_EQ(fbs_decoder_get_vertices(decoder.get(), vertices, &count), FBS_ERROR_NO_FACE);
  EXPECT_EQ(count, 0U);
  EXPECT_STREQ(fbs_decoder_error(decoder.get()), "the scene has no face");
}

}  // namespace
}  // namespace fbs
