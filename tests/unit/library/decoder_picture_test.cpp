// Pictures in memory of the decoder and of the caller.
#include <array>
#include <cmath>
#include <cstring>

#include "tests/unit/library/api_decoder.h"

namespace fbs {
namespace {

constexpr std::uint8_t kGuard = 0xA5;

/// Three planes somewhere in one block of memory, with room around each row.
class CallerMemory {
 public:
  /// @param slack       bytes behind each row; stride = width + slack
  /// @param upside_down  rows from the bottom up, with negative strides
  CallerMemory(std::uint32_t width, std::uint32_t height, std::size_t slack, bool upside_down)
      : picture_{width, height, {}, {}} {
    std::vector<std::size_t> begins;
    for (int k = 0; k < 3; ++k) {
      begins.push_back(bytes_.size() + 13);
      bytes_.resize(begins.back() + (plane_width(width, k) + slack) * plane_width(height, k) + 13, kGuard);
    }
    std::fill(bytes_.begin(), bytes_.end(), kGuard);
    for (int k = 0; k < 3; ++k) {
      const auto stride = static_cast<std::ptrdiff_t>(plane_width(width, k) + slack);
      const auto rows = static_cast<std::ptrdiff_t>(plane_width(height, k));
      picture_.data[k] =
          bytes_.data() + begins[static_cast<std::size_t>(k)] + (upside_down ? stride * (rows - 1) : 0);
      picture_.stride[k] = upside_down ? -stride : stride;
    }
  }

  [[nodiscard]] const fbs_picture& picture() const { return picture_; }

  [[nodiscard]] std::vector<std::uint8_t> samples() const {
    return samples_of({picture_.width,
                       picture_.height,
                       {picture_.data[0], picture_.data[1], picture_.data[2]},
                       {picture_.stride[0], picture_.stride[1], picture_.stride[2]}});
  }

  /// Bytes that are not samples and have been written.
  [[nodiscard]] std::size_t touched() {
    for (int k = 0; k < 3; ++k)
      for (std::size_t y = 0; y < plane_width(picture_.height, k); ++y)
        std::fill_n(picture_.data[k] + static_cast<std::ptrdiff_t>(y) * picture_.stride[k],
                    plane_width(picture_.width, k), kGuard);
    return bytes_.size() - static_cast<std::size_t>(std::count(bytes_.begin(), bytes_.end(), kGuard));
  }

 private:
  std::vector<std::uint8_t> bytes_;
  fbs_picture picture_;
};

TEST(DecoderPicture, DrawsIntoAnyLayout) {
  for (const std::string vector : {"odd.fbs", "talk.fbs", "nobody.fbs", "patterns.fbs"}) {
    const ApiDecoder decoder = at_first_picture(vector);
    fbs_const_picture own;
    ASSERT_EQ(fbs_decoder_get_picture(decoder.get(), &own), FBS_OK);
    const auto expected = samples_of(own);
    for (const std::size_t slack : {0u, 1u, 3u, 64u})
      for (const bool upside_down : {false, true}) {
        CallerMemory memory(own.width, own.height, slack, upside_down);
        ASSERT_EQ(fbs_decoder_draw(decoder.get(), &memory.picture()), FBS_OK);
        EXPECT_EQ(memory.samples(), expected) << vector << ' ' << slack << ' ' << upside_down;
        EXPECT_EQ(memory.touched(), 0u) << vector << ' ' << slack << ' ' << upside_down;
      }
  }
}

TEST(DecoderPicture, TheStateThatWasSentDrawsThePictureThatWasSent) {
  for (const std::string vector : {"odd.fbs", "talk.fbs", "patterns.fbs"}) {
    const ApiDecoder decoder = at_first_picture(vector);
    do {
      fbs_face_state state;
      ASSERT_EQ(fbs_decoder_get_state(decoder.get(), &state), FBS_OK);
      const auto sent = shown_by(decoder.get());
      fbs_format format;
      ASSERT_EQ(fbs_decoder_get_format(decoder.get(), &format), FBS_OK);
      CallerMemory memory(format.width, format.height, 3, false);
      ASSERT_EQ(fbs_decoder_draw_state(decoder.get(), &state, &memory.picture()), FBS_OK);
      EXPECT_EQ(memory.samples(), sent) << vector;
      EXPECT_EQ(memory.touched(), 0u);
    } while (fbs_decoder_next(decoder.get(), nullptr) == FBS_OK);
  }
}

struct Described {
  fbs_face_state state;
  std::array<fbs_landmark, FBS_LANDMARKS> landmarks;
  std::array<float, FBS_BLENDSHAPES> weights;

  explicit Described(const ApiDecoder& decoder) {
    EXPECT_EQ(fbs_decoder_get_state(decoder.get(), &state), FBS_OK);
    EXPECT_EQ(fbs_decoder_get_landmarks(decoder.get(), landmarks.data()), FBS_OK);
    EXPECT_EQ(fbs_decoder_get_blendshapes(decoder.get(), weights.data()), FBS_OK);
  }
};

TEST(DecoderPicture, AnEditMovesTheFaceAlone) {
  const ApiDecoder decoder = at_first_picture("talk.fbs");
  const auto sent = shown_by(decoder.get());
  const Described plain(decoder);
  fbs_face_edit edit{};
  ASSERT_EQ(fbs_decoder_set_edit(decoder.get(), &edit), FBS_OK);
  EXPECT_EQ(shown_by(decoder.get()), sent);
  edit.yaw = 10;
  edit.mouth = 1;
  ASSERT_EQ(fbs_decoder_set_edit(decoder.get(), &edit), FBS_OK);
  const Described edited(decoder);
  EXPECT_NEAR(edited.state.yaw, plain.state.yaw + 10, 0.01);
  EXPECT_GT(edited.weights[0], plain.weights[0] + 0.5f) << "jawOpen";
  EXPECT_GT(std::abs(edited.landmarks[30].x - plain.landmarks[30].x), 1) << "the tip of the nose";
  const auto drawn = shown_by(decoder.get());
  EXPECT_NE(drawn, sent);
  EXPECT_EQ(drawn[0], sent[0]) << "the corner of the background stays";
  fbs_format format;
  ASSERT_EQ(fbs_decoder_get_format(decoder.get(), &format), FBS_OK);
  CallerMemory memory(format.width, format.height, 0, false);
  ASSERT_EQ(fbs_decoder_draw(decoder.get(), &memory.picture()), FBS_OK);
  EXPECT_EQ(memory.samples(), drawn);
  ASSERT_EQ(fbs_decoder_draw_state(decoder.get(), &edited.state, &memory.picture()), FBS_OK);
  EXPECT_EQ(memory.samples(), drawn);
  ASSERT_EQ(fbs_decoder_draw_state(decoder.get(), &plain.state, &memory.picture()), FBS_OK);
  EXPECT_EQ(memory.samples(), sent) << "a state of the caller's is not edited";
  ASSERT_EQ(fbs_decoder_set_edit(decoder.get(), nullptr), FBS_OK);
  EXPECT_EQ(shown_by(decoder.get()), sent);
}

TEST(DecoderPicture, AnEditStaysWhenTheDecoderIsReset) {
  const ApiDecoder decoder = at_first_picture("talk.fbs");
  const auto sent = shown_by(decoder.get());
  const fbs_face_edit edit{0, 10, 0, 0, 0, 0, 0}, fault{0, NAN, 0, 0, 0, 0, 0};
  ASSERT_EQ(fbs_decoder_set_edit(decoder.get(), &edit), FBS_OK);
  EXPECT_EQ(fbs_decoder_set_edit(decoder.get(), &fault), FBS_ERROR_ARGUMENT);
  const auto edited = shown_by(decoder.get());
  EXPECT_NE(edited, sent);
  ASSERT_EQ(fbs_decoder_reset(decoder.get()), FBS_OK);
  const auto bytes = vector_bytes("talk.fbs");
  ASSERT_EQ(fbs_decoder_feed(decoder.get(), bytes.data(), bytes.size()), FBS_OK);
  ASSERT_EQ(fbs_decoder_next(decoder.get(), nullptr), FBS_OK);
  EXPECT_EQ(shown_by(decoder.get()), edited);
}

TEST(DecoderPicture, StatesNeedAFaceAndLimits) {
  const ApiDecoder decoder = at_first_picture("talk.fbs");
  fbs_face_state state;
  ASSERT_EQ(fbs_decoder_get_state(decoder.get(), &state), FBS_OK);
  fbs_format format;
  ASSERT_EQ(fbs_decoder_get_format(decoder.get(), &format), FBS_OK);
  CallerMemory memory(format.width, format.height, 0, false);
  state.yaw = 91;
  EXPECT_EQ(fbs_decoder_draw_state(decoder.get(), &state, &memory.picture()), FBS_ERROR_ARGUMENT);
  EXPECT_STREQ(fbs_decoder_error(decoder.get()), "a number of the state is beyond the limits of the format");

  const ApiDecoder nobody = at_first_picture("nobody.fbs");
  ASSERT_EQ(fbs_decoder_get_format(nobody.get(), &format), FBS_OK);
  CallerMemory other(format.width, format.height, 0, false);
  state.yaw = 0;
  float weights[FBS_BLENDSHAPES];
  EXPECT_EQ(fbs_decoder_draw_state(nobody.get(), &state, &other.picture()), FBS_ERROR_NO_FACE);
  EXPECT_EQ(fbs_decoder_get_state(nobody.get(), &state), FBS_ERROR_NO_FACE);
  EXPECT_EQ(fbs_decoder_get_blendshapes(nobody.get(), weights), FBS_ERROR_NO_FACE);
}

TEST(DecoderPicture, BlendshapesHaveNamesAndFollowTheMouth) {
  const ApiDecoder decoder = at_first_picture("talk.fbs");
  EXPECT_STREQ(fbs_blendshape_name(0), "jawOpen");
  for (std::size_t k = 0; k < FBS_BLENDSHAPES; ++k) EXPECT_STRNE(fbs_blendshape_name(k), nullptr) << k;
  EXPECT_EQ(fbs_blendshape_name(FBS_BLENDSHAPES), nullptr);
  float widest = 0;
  do {
    std::array<float, FBS_BLENDSHAPES> weights;
    weights.fill(NAN);
    ASSERT_EQ(fbs_decoder_get_blendshapes(decoder.get(), weights.data()), FBS_OK);
    for (const float w : weights) EXPECT_TRUE(std::isfinite(w));
    widest = std::max(widest, weights[0]);
  } while (fbs_decoder_next(decoder.get(), nullptr) == FBS_OK);
  EXPECT_GT(widest, 0.05F) << "the talker opens the jaw";
}

TEST(DecoderPicture, EveryPictureIsTheSameInTheCallersMemory) {
  const ApiDecoder decoder = at_first_picture("turns.fbs");
  fbs_format format;
  ASSERT_EQ(fbs_decoder_get_format(decoder.get(), &format), FBS_OK);
  do {
    CallerMemory memory(format.width, format.height, 5, true);
    ASSERT_EQ(fbs_decoder_draw(decoder.get(), &memory.picture()), FBS_OK);
    EXPECT_EQ(memory.samples(), shown_by(decoder.get()));
    EXPECT_EQ(memory.touched(), 0u);
  } while (fbs_decoder_next(decoder.get(), nullptr) == FBS_OK);
}

TEST(DecoderPicture, RefusesOtherSizesAndNarrowStrides) {
  const ApiDecoder decoder = at_first_picture("odd.fbs");
  fbs_format format;
  ASSERT_EQ(fbs_decoder_get_format(decoder.get(), &format), FBS_OK);
  CallerMemory memory(format.width, format.height, 2, false);
  const auto refuses = [&](auto&& change) {
    fbs_picture picture = memory.picture();
    change(picture);
    return fbs_decoder_draw(decoder.get(), &picture) == FBS_ERROR_ARGUMENT && memory.touched() == 0;
  };
  EXPECT_TRUE(refuses([](fbs_picture& p) { ++p.width; }));
  EXPECT_TRUE(refuses([](fbs_picture& p) { --p.height; }));
  EXPECT_TRUE(refuses([](fbs_picture& p) { p.width = 0; }));
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(refuses([&](fbs_picture& p) { p.data[k] = nullptr; }));
    EXPECT_TRUE(refuses([&](fbs_picture& p) { p.stride[k] -= 3; }));
    EXPECT_TRUE(refuses([&](fbs_picture& p) { p.stride[k] = 3 - p.stride[k]; }));
    EXPECT_TRUE(refuses([&](fbs_picture& p) { p.stride[k] = 0; }));
  }
  EXPECT_EQ(fbs_decoder_draw(decoder.get(), &memory.picture()), FBS_OK);
}

TEST(DecoderPicture, StaysWhileOthersAreAskedFor) {
  const ApiDecoder decoder = at_first_picture("talk.fbs");
  fbs_const_picture first, again;
  ASSERT_EQ(fbs_decoder_get_picture(decoder.get(), &first), FBS_OK);
  const auto samples = samples_of(first);
  fbs_format format;
  fbs_face_state state;
  fbs_landmark landmarks[FBS_LANDMARKS];
  fbs_vertex vertices[FBS_MAX_VERTICES];
  size_t count = FBS_MAX_VERTICES;
  ASSERT_EQ(fbs_decoder_get_format(decoder.get(), &format), FBS_OK);
  ASSERT_EQ(fbs_decoder_get_state(decoder.get(), &state), FBS_OK);
  ASSERT_EQ(fbs_decoder_get_landmarks(decoder.get(), landmarks), FBS_OK);
  ASSERT_EQ(fbs_decoder_get_vertices(decoder.get(), vertices, &count), FBS_OK);
  ASSERT_EQ(fbs_decoder_get_picture(decoder.get(), &again), FBS_OK);
  EXPECT_EQ(again.data[0], first.data[0]);
  EXPECT_EQ(samples_of(first), samples);
  for (int k = 0; k < 10; ++k) ASSERT_EQ(fbs_decoder_next(decoder.get(), nullptr), FBS_OK);
  EXPECT_NE(shown_by(decoder.get()), samples);
}

// What has arrived behind the picture does not change it.
TEST(DecoderPicture, IsTheOneAnnouncedLast) {
  const ApiDecoder decoder = api_decoder();
  std::vector<std::uint8_t> last;
  for (const std::uint8_t byte : vector_bytes("late.fbs")) {
    ASSERT_EQ(fbs_decoder_feed(decoder.get(), &byte, 1), FBS_OK);
    if (!last.empty()) {
      ASSERT_EQ(shown_by(decoder.get()), last);
    }
    while (fbs_decoder_next(decoder.get(), nullptr) == FBS_OK) last = shown_by(decoder.get());
    fbs_const_picture picture;
    if (last.empty()) {
      ASSERT_EQ(fbs_decoder_get_picture(decoder.get(), &picture), FBS_ERROR_ARGUMENT);
    }
  }
  EXPECT_FALSE(last.empty());
}

}  // namespace
}  // namespace fbs
