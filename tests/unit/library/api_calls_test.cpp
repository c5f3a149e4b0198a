// Invalid calls, and calls in any order: nothing crashes, and the documentation holds.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <random>

#include "tests/unit/library/api_decoder.h"

namespace fbs {
namespace {

TEST(ApiCalls, NullPointersAreAnswered) {
  fbs_picture_info info;
  fbs_const_picture picture;
  fbs_picture memory{};
  fbs_format format;
  fbs_face_state state{};
  const fbs_face_edit edit{};
  float weights[FBS_BLENDSHAPES];
  fbs_landmark landmarks[FBS_LANDMARKS];
  fbs_vertex vertices[FBS_MAX_VERTICES];
  size_t count = FBS_MAX_VERTICES;
  const std::uint8_t byte = 0;
  fbs_decoder* none = nullptr;
  fbs_decoder_default_settings(nullptr, sizeof(fbs_decoder_settings));
  EXPECT_EQ(fbs_decoder_open(nullptr, nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_feed(none, &byte, 1), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_finish(none), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_feed_packet(none, 0, nullptr, 0), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_get_missing(none, nullptr, 0, nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_packets_lost(none, 0), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_skip_missing(none), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_needs_scene(none), 0);
  EXPECT_EQ(fbs_decoder_next(none, &info), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_reset(none), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_get_picture(none, &picture), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_draw(none, &memory), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_draw_state(none, &state, &memory), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_set_edit(none, &edit), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_get_blendshapes(none, weights), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_get_format(none, &format), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_get_state(none, &state), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_get_landmarks(none, landmarks), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_get_vertices(none, vertices, &count), FBS_ERROR_ARGUMENT);
  EXPECT_STREQ(fbs_decoder_error(none), "");
  EXPECT_EQ(fbs_decoder_error_offset(none), 0u);
  fbs_decoder_close(nullptr);
  fbs_decoder_close(&none);

  for (const ApiDecoder& decoder : {api_decoder(), at_first_picture("one.fbs")}) {
    fbs_decoder* const d = decoder.get();
    EXPECT_EQ(fbs_decoder_feed(d, nullptr, 1), FBS_ERROR_ARGUMENT);
    EXPECT_EQ(fbs_decoder_get_picture(d, nullptr), FBS_ERROR_ARGUMENT);
    EXPECT_EQ(fbs_decoder_draw(d, nullptr), FBS_ERROR_ARGUMENT);
    EXPECT_EQ(fbs_decoder_draw(d, &memory), FBS_ERROR_ARGUMENT);
    EXPECT_EQ(fbs_decoder_draw_state(d, nullptr, &memory), FBS_ERROR_ARGUMENT);
    EXPECT_EQ(fbs_decoder_draw_state(d, &state, nullptr), FBS_ERROR_ARGUMENT);
    EXPECT_EQ(fbs_decoder_get_blendshapes(d, nullptr), FBS_ERROR_ARGUMENT);
    EXPECT_EQ(fbs_decoder_get_format(d, nullptr), FBS_ERROR_ARGUMENT);
    EXPECT_EQ(fbs_decoder_get_state(d, nullptr), FBS_ERROR_ARGUMENT);
    EXPECT_EQ(fbs_decoder_get_landmarks(d, nullptr), FBS_ERROR_ARGUMENT);
    EXPECT_EQ(fbs_decoder_get_vertices(d, nullptr, nullptr), FBS_ERROR_ARGUMENT);
    EXPECT_STRNE(fbs_decoder_error(d), "");
  }
}

TEST(ApiCalls, CloseForgetsTheObject) {
  fbs_decoder* decoder = api_decoder().release();
  fbs_decoder_close(&decoder);
  EXPECT_EQ(decoder, nullptr);
  fbs_decoder_close(&decoder);
}

TEST(ApiCalls, FailureLeavesNoObject) {
  fbs_decoder_settings settings{};
  auto* decoder = reinterpret_cast<fbs_decoder*>(&settings);
  EXPECT_EQ(fbs_decoder_open(&decoder, &settings), FBS_ERROR_ARGUMENT) << "struct_size is 0";
  EXPECT_EQ(decoder, nullptr);
}

// A program compiled with a later header, and one with an earlier.
TEST(ApiCalls, SettingsMayBeOfAnotherVersion) {
  struct Later {
    fbs_decoder_settings known;
    std::uint64_t unknown;
  } later;
  std::memset(static_cast<void*>(&later), 0xFF, sizeof later);
  fbs_decoder_default_settings(&later.known, sizeof later);
  EXPECT_EQ(later.known.struct_size, sizeof later);
  EXPECT_EQ(later.unknown, 0u);
  fbs_decoder* decoder = nullptr;
  EXPECT_EQ(fbs_decoder_open(&decoder, &later.known), FBS_OK);
  fbs_decoder_close(&decoder);
  later.unknown = 1;
  EXPECT_EQ(fbs_decoder_open(&decoder, &later.known), FBS_ERROR_ARGUMENT) << "it asks for what we cannot do";
  fbs_decoder_settings earlier;  // of version 0.2
  fbs_decoder_default_settings(&earlier, offsetof(fbs_decoder_settings, open_error));
  earlier.open_error = reinterpret_cast<char*>(1);  // what comes to lie there
  EXPECT_EQ(fbs_decoder_open(&decoder, &earlier), FBS_OK);
  fbs_decoder_close(&decoder);

  fbs_decoder_settings untouched{77, 77, 77, nullptr, nullptr, nullptr, nullptr};
  fbs_decoder_default_settings(&untouched, sizeof untouched.struct_size);
  EXPECT_EQ(untouched.struct_size, 77u) << "no version is so small";
}

/// Calls functions of a decoder in random order with random arguments, and checks what holds in any order.
class RandomCalls {
 public:
  RandomCalls(unsigned seed, std::span<const std::vector<std::uint8_t>> streams)
      : random_(seed), streams_(streams), decoder_(api_decoder(random_() % 8 == 0 ? 5000 : 0)) {}

  void run(int calls) {
    for (int k = 0; k < calls; ++k) call();
  }

 private:
  fbs_decoder* get() { return decoder_.get(); }

  void call() {
    switch (random_() % 12) {
      case 0:
      case 1:
      case 2:
        return feed();
      case 3:
      case 4:
      case 5:
        return next();
      case 6:
        return draw();
      case 7:
        EXPECT_NE(fbs_decoder_skip_missing(get()), FBS_ERROR_ARGUMENT);
        return ask();
      case 8:
        return read_picture();
      case 9:
        if (random_() % 8 == 0) {
          EXPECT_EQ(fbs_decoder_finish(get()), FBS_OK);
          finished_ = true;
        }
        return;
      case 10:
        if (random_() % 8 == 0) reset();
        return;
      default:
        EXPECT_NE(fbs_decoder_error(get()), nullptr);
    }
  }

  void feed() {
    const auto& stream = streams_[stream_];
    if (random_() % 16 == 0) at_ = random_() % (stream.size() + 1);
    const std::size_t size = std::min<std::size_t>(stream.size() - at_, random_() % 900);
    const bool in_packets = random_() % 4 == 0;
    const bool mixed = kind_ && *kind_ != in_packets;
    const fbs_status status =
        in_packets ? fbs_decoder_feed_packet(get(), number_ + random_() % 4, stream.data() + at_, size)
                   : fbs_decoder_feed(get(), stream.data() + at_, size);
    EXPECT_EQ(status, finished_ || mixed ? FBS_ERROR_ARGUMENT : FBS_OK);
    if (status != FBS_OK) return;
    if (size > 0) kind_ = in_packets;
    if (in_packets) ++number_;
    at_ += size;
  }

  void next() {
    fbs_picture_info info{1, 2, 0, 5, 5, 5};
    const fbs_status status = fbs_decoder_next(get(), random_() % 2 == 0 ? &info : nullptr);
    EXPECT_NE(status, FBS_ERROR_INTERNAL) << fbs_decoder_error(get());
    EXPECT_NE(status, FBS_ERROR_ARGUMENT) << fbs_decoder_error(get());
    if (finished_) {
      EXPECT_NE(status, FBS_NEED_DATA);
    } else {
      EXPECT_NE(status, FBS_END);
    }
    has_picture_ = has_picture_ || status == FBS_OK;
  }

  void draw() {
    fbs_format format{};
    if (fbs_decoder_get_format(get(), &format) != FBS_OK) format.width = format.height = 64;
    std::vector<std::uint8_t> memory(std::size_t{3} * format.width * format.height);
    const auto stride =
        static_cast<std::ptrdiff_t>(random_() % (format.width + 1) / 2 + format.width / 2 + 1);
    std::uint8_t* const at = memory.data();
    const auto wrong = static_cast<std::uint32_t>(random_() % 2);
    const fbs_picture picture = {format.width - wrong, format.height, {at, at, at}, {stride, stride, stride}};
    const fbs_status status = fbs_decoder_draw(get(), &picture);
    const bool fits = picture.width == format.width && stride >= static_cast<std::ptrdiff_t>(format.width);
    EXPECT_EQ(status, has_picture_ && fits ? FBS_OK : FBS_ERROR_ARGUMENT) << fbs_decoder_error(get());
  }

  void ask() {
    fbs_face_state state;
    fbs_landmark landmarks[FBS_LANDMARKS];
    fbs_vertex vertices[FBS_MAX_VERTICES];
    size_t count = FBS_MAX_VERTICES;
    const fbs_status status = fbs_decoder_get_state(get(), &state);
    EXPECT_EQ(fbs_decoder_get_landmarks(get(), landmarks), status);
    EXPECT_EQ(fbs_decoder_get_vertices(get(), vertices, &count), status);
    EXPECT_EQ(status == FBS_ERROR_ARGUMENT, !has_picture_);
    float weights[FBS_BLENDSHAPES];
    EXPECT_EQ(fbs_decoder_get_blendshapes(get(), weights), status);
    if (status == FBS_OK && random_() % 4 == 0) draw_edited(state);
    if (status != FBS_OK) {
      EXPECT_TRUE(status == FBS_ERROR_ARGUMENT || status == FBS_ERROR_NO_FACE);
      return;
    }
    for (const fbs_landmark& point : landmarks) EXPECT_TRUE(point.confidence >= 0 && point.confidence <= 1);
  }

  /// Any state within the limits is drawn.
  void draw_edited(fbs_face_state state) {
    const auto any = [&](float limit) {
      return limit * (static_cast<float>(random_()) / static_cast<float>(std::mt19937::max()) * 2 - 1);
    };
    const fbs_face_edit edit = {any(20), any(30), any(20), any(2), any(2), any(2), any(2)};
    EXPECT_EQ(fbs_decoder_set_edit(get(), &edit), FBS_OK);
    EXPECT_EQ(fbs_decoder_get_state(get(), &state), FBS_OK);
    if (random_() % 2 == 0) {
      state.yaw = any(90);
      state.eye_distance = 1 + std::abs(any(300));
      state.control[random_() % FBS_CONTROL_POINTS][0] = any(2);
    }
    fbs_format format{};
    EXPECT_EQ(fbs_decoder_get_format(get(), &format), FBS_OK);
    std::vector<std::uint8_t> memory(std::size_t{3} * format.width * format.height);
    const auto stride = static_cast<std::ptrdiff_t>(format.width);
    const fbs_picture picture = {
        format.width, format.height, {memory.data(), memory.data(), memory.data()}, {stride, stride, stride}};
    EXPECT_EQ(fbs_decoder_draw_state(get(), &state, &picture), FBS_OK) << fbs_decoder_error(get());
  }

  void read_picture() {
    fbs_const_picture picture;
    const fbs_status status = fbs_decoder_get_picture(get(), &picture);
    EXPECT_EQ(status, has_picture_ ? FBS_OK : FBS_ERROR_ARGUMENT);
    if (status == FBS_OK) {
      EXPECT_GE(samples_of(picture).size(), std::size_t{64 * 64});
    }
  }

  void reset() {
    EXPECT_EQ(fbs_decoder_reset(get()), FBS_OK);
    finished_ = has_picture_ = false;
    kind_.reset();
    stream_ = random_() % streams_.size();
    at_ = random_() % 2 == 0 ? 0 : 4;
  }

  std::mt19937 random_;
  std::span<const std::vector<std::uint8_t>> streams_;
  ApiDecoder decoder_;
  std::size_t stream_ = 0, at_ = 0;
  std::uint64_t number_ = 0;  // of a packet of a link
  std::optional<bool> kind_;  // whether packets have been fed, or bytes
  bool finished_ = false, has_picture_ = false;
};

// FBS_SEQUENCES=100000 build/release/fbs_unit_tests --gtest_filter=ApiCalls.ComeInAnyOrder
TEST(ApiCalls, ComeInAnyOrder) {
  std::vector<std::vector<std::uint8_t>> streams;
  for (const char* name : {"talk.fbs", "one.fbs", "nobody.fbs", "odd.fbs", "late.fbs", "joined.fbs",
                           "patterns.fbs", "lost_scene.fbs", "flipped_bits.fbs", "not_fbs.fbs"})
    streams.push_back(vector_bytes(name));
  const char* const wished = std::getenv("FBS_SEQUENCES");  // NOLINT(concurrency-mt-unsafe)
  const unsigned sequences = wished != nullptr ? static_cast<unsigned>(std::atoi(wished)) : 300;
  for (unsigned seed = 0; seed < sequences && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomCalls(seed, streams).run(120);
  }
}

}  // namespace
}  // namespace fbs
