// Bytes to a few small pictures, settings and calls in any order: whatever the encoder refuses, it refuses
// with an error that blames the caller, and each stream that it finishes decodes to the pictures that it
// took.
#include "encoder/encoder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "bitstream/byte_io.h"
#include "decoder/stream/stream_decoder.h"
#include "tests/fuzz/byte_mutator.h"
#include "tests/talker/talker_render.h"

namespace {

using fbs::EncoderSettings;
using fbs::ErrorCode;
using fbs::Picture;
using fbs::VideoFormat;

constexpr int kSideRange = 33;  // sides are 64..96: one picture takes some 10 ms
constexpr int kMaxPictures = 4, kFrames = 12;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Choices read from the input; zeros past its end.
class Choices {
 public:
  explicit Choices(std::span<const std::uint8_t> bytes) : reader_(bytes) {}
  int below(int count) { return reader_.u8() % count; }
  bool flag() { return (reader_.u8() & 1) != 0; }
  template <class Value>
  Value of(std::initializer_list<Value> values) {
    return values.begin()[reader_.u8() % values.size()];
  }

 private:
  fbs::ByteReader reader_;
};

VideoFormat read_format(Choices& choices) {
  VideoFormat format;
  format.width = fbs::kMinPictureSize + choices.below(kSideRange);
  format.height = fbs::kMinPictureSize + choices.below(kSideRange);
  format.frame_rate =
      choices.of<fbs::Rational>({{25, 1}, {30000, 1001}, {1, 1}, {1000, 1}, {1, 60}, {1, 4000000000U}});
  format.pixel_aspect = choices.of<fbs::Rational>({{1, 1}, {0, 1}, {16, 11}});
  format.range = choices.of({fbs::ColourRange::kLimited, fbs::ColourRange::kFull});
  return format;
}

EncoderSettings read_settings(Choices& choices) {
  EncoderSettings s;
  s.quality = choices.of({50, 0, 30, 70, 100});
  s.bitrate = choices.of({0.0, 0.0, 0.0, 5.0, 0.001, 1e9});
  s.seconds = choices.of({0.0, 0.01, 1e9});
  s.motion_bitrate = choices.of({0.0, 0.0, 0.0, 1.0, 1e-9, 1e9});
  s.patterns = choices.of({0, 1, 2, 64});
  s.pattern_quantiser = choices.of({-1, -1, 0, 63});
  s.reduced_patterns = choices.of<std::optional<bool>>({std::nullopt, std::nullopt, true, false});
  s.effort = choices.below(2);
  s.face = choices.of({0, 0, 0, 1, 1000000});
  s.allow_no_face = !choices.flag();
  s.expression = !choices.flag();
  s.contours = !choices.flag();
  s.descent = !choices.flag();
  s.track_only = choices.flag() && s.expression && s.contours;
  s.landmark_search = !choices.flag();
  s.surround = !choices.flag();
  s.key_interval = choices.of({0.0, 0.0, 0.1, 1e-9, 1e9});
  s.threads = choices.of({1, 2, 0, 1000000});
  s.group_pictures = choices.of({0, 1, 2, 256});
  if (choices.flag()) {
    s.live.emplace();
    s.live->delay = choices.of({0.2, 1e-9, 1e9});
    s.live->buffer = choices.of({2.0, 1e-9, 1e9});
    if (s.patterns > 1) s.patterns = 0;
  }
  return s;
}

/// Sets a number out of its range, sometimes.
/// @return whether the encoder must refuse it
bool spoil(Choices& choices, VideoFormat& format, EncoderSettings& s) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const double bad = choices.of({-1.0, kInfinity, -kInfinity, kNaN});
  switch (choices.below(64)) {
    case 1:
      return s.quality = choices.of({-1, 101, std::numeric_limits<int>::max()}), true;
    case 2:
      return s.bitrate = bad, true;
    case 3:
      return s.seconds = bad, true;
    case 4:
      return s.motion_bitrate = bad, true;
    case 5:
      return s.patterns = choices.of({-1, 65}), true;
    case 6:
      return s.pattern_quantiser = choices.of({-2, 64}), true;
    case 7:
      return s.key_interval = bad, true;
    case 8:
      return s.live.emplace().delay = bad, true;
    case 9:
      return s.live.emplace().buffer = bad, true;
    case 10:
      return s.group_pictures = choices.of({-1, 257}), true;
    case 11:
      return s.effort = -1, true;
    case 12:
      return s.threads = -1, true;
    case 13:
      return s.face = -1, true;
    case 14:
      return format.width = choices.of({-1, 0, 63, 8193, std::numeric_limits<int>::max()}), true;
    case 15:
      return format.height = choices.of({-1, 0, 63, 8193, std::numeric_limits<int>::max()}), true;
    case 16:
      return format.frame_rate = choices.of<fbs::Rational>({{0, 1}, {1, 0}, {1001, 1}}), true;
    case 17:
      return format.pixel_aspect = {1, 0}, true;
    case 18:
      return format.matrix = static_cast<fbs::ColourMatrix>(3), true;
    default:
      return false;
  }
}

/// Frame of a talking head, drawn once.
const Picture& face_picture(int width, int height, int frame) {
  static std::map<std::tuple<int, int, int>, Picture> drawn;
  const auto key = std::tuple(width, height, frame);
  if (const auto found = drawn.find(key); found != drawn.end()) return found->second;
  if (drawn.size() > 500) drawn.clear();
  fbs::talker::Settings settings;
  settings.width = width;
  settings.height = height;
  settings.frame_count = 30 * kFrames;
  settings.eye_distance = 0.25F;
  const fbs::talker::Talker talker(settings);
  return drawn.emplace(key, talker.picture(frame)).first->second;
}

std::uint8_t structured(int kind, int x, int y, int amount) {
  switch (kind) {
    case 0:
      return static_cast<std::uint8_t>(amount);
    case 1:
      return static_cast<std::uint8_t>((x * amount >> 3) + y);
    case 2:
      return (x / (1 + amount % 16) + y / (1 + amount % 16)) % 2 == 0 ? 0 : 255;
    default:
      return static_cast<std::uint8_t>(x < amount % 64 ? 16 : 235);
  }
}

Picture read_picture(Choices& choices, int width, int height, const Picture& last) {
  Picture out(width, height);
  const int content = choices.below(16), amount = choices.below(256);
  if (content < 8) return face_picture(width, height, amount % kFrames * 25);
  if (content == 8) return last.empty() ? out : last;
  if (content == 9) {
    fbs::fuzz::Random random(static_cast<unsigned>(amount));
    for (fbs::Plane* plane : {&out.y, &out.u, &out.v})
      for (auto& sample : plane->samples) sample = static_cast<std::uint8_t>(random());
    return out;
  }
  for (fbs::Plane* plane : {&out.y, &out.u, &out.v})
    for (int y = 0; y < plane->height; ++y)
      for (int x = 0; x < plane->width; ++x) plane->row(y)[x] = structured(content % 4, x, y, amount);
  return out;
}

std::uint32_t read_duration(Choices& choices) {
  return choices.of<std::uint32_t>({0, 0, 0, 0, 3600, 1, 3000, fbs::kMaxDuration, fbs::kMaxDuration + 1,
                                    std::numeric_limits<std::uint32_t>::max()});
}

fbs::Marks read_marks(Choices& choices) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  fbs::Marks marks;
  const double scale = choices.of({1.0, 0.0, 1e-9, 1e9, kInfinity, kNaN});
  for (int k = 0; k < fbs::kLandmarkCount; ++k)
    if (choices.below(4) != 1)
      marks.set_landmark(k, {choices.below(100) * scale, choices.below(100) * scale});
  return marks;
}

/// One video, from its first call to its last.
class Session {
 public:
  Session(fbs::Encoder encoder, const VideoFormat& format) : encoder_(std::move(encoder)), format_(format) {}

  void run(Choices& choices) {
    const int calls = 1 + choices.below(kMaxPictures);
    for (int call = 0; call < calls && !failed_; ++call) {
      if (choices.below(16) == 1) misuse(choices);
      push(choices);
      if (choices.flag()) take();
    }
    const auto finished = encoder_.finish();
    if (!finished) return check(finished.error());
    take();
    if (!failed_) check_stream();
    require(refused(encoder_.finish()) && refused(encoder_.push(last_)), "a call after the last");
    require(encoder_.take().empty(), "bytes after the end");
  }

 private:
  static void check(const fbs::Error& error) {
    if (error.code == ErrorCode::kInternal) std::fprintf(stderr, "%s\n", error.text.c_str());
    require(error.code != ErrorCode::kInternal, "internal error");
  }

  static bool refused(const fbs::Result<void>& result) {
    return !result && result.error().code == ErrorCode::kInvalidArgument;
  }

  /// Calls that must be refused and change nothing.
  void misuse(Choices& choices) {
    Picture picture(format_.width, format_.height);
    std::uint32_t duration = 0;
    switch (choices.below(4)) {
      case 0:
        picture = Picture(format_.width + 1, format_.height);
        break;
      case 1:
        picture = {};
        break;
      case 2:
        picture.u = fbs::Plane(1, 1);
        break;
      default:
        duration = fbs::kMaxDuration + 1;
        break;
    }
    require(refused(encoder_.push(picture, duration)), "a wrong picture is taken");
  }

  void push(Choices& choices) {
    const Picture picture = read_picture(choices, format_.width, format_.height, last_);
    const std::uint32_t duration = read_duration(choices);
    std::optional<std::uint64_t> begin;
    if (choices.below(4) == 3) {
      begin_ += static_cast<std::uint64_t>(choices.below(200)) * (choices.below(8) == 0 ? 50'000 : 50);
      begin = begin_;
      timed_ = true;
    }
    const auto pushed = encoder_.push(picture, {duration, begin});
    if (duration > fbs::kMaxDuration) {
      require(refused(pushed), "too long a duration is taken");
      return;
    }
    failed_ = !pushed;
    if (failed_) return check(pushed.error());
    last_ = picture;
    durations_.push_back(duration > 0 ? duration : fbs::nominal_duration(format_.frame_rate));
    require(encoder_.report().pictures == durations_.size(), "a wrong number of pictures is reported");
    (void)encoder_.analysis();
    (void)encoder_.is_coding();
  }

  void take() {
    const auto bytes = encoder_.take();
    stream_.insert(stream_.end(), bytes.begin(), bytes.end());
  }

  void check_stream() const {
    fbs::StreamDecoder decoder;
    decoder.feed(stream_);
    decoder.close();
    Picture picture;
    for (const std::uint32_t duration : durations_) {
      const auto status = decoder.next();
      if (!status) std::fprintf(stderr, "%s\n", status.error().text.c_str());
      require(status && *status == fbs::DecodeStatus::kPicture, "a picture is missing");
      require(!decoder.held() && (timed_ || decoder.duration() == duration), "a picture of another duration");
      require(decoder.render(picture) && picture.width() == last_.width(), "a picture is not drawn");
    }
    require(decoder.next() == fbs::DecodeStatus::kEnd, "too many pictures");
    require(decoder.announced_pictures() == durations_.size(), "the end says another number");
  }

  fbs::Encoder encoder_;
  VideoFormat format_;
  fbs::fuzz::Bytes stream_;
  std::vector<std::uint32_t> durations_;  // of the pictures taken, unless they have times to begin
  bool timed_ = false;                    // one has
  std::uint64_t begin_ = 0;
  Picture last_;
  bool failed_ = false;  // by a push, after which the stream is useless
};

}  // namespace

/// Any bytes are choices: the first bytes of a stream are some.
std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  constexpr std::size_t kBytes = 90;
  return {
      Bytes(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(std::min(kBytes, stream.size())))};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices({data, size});
  VideoFormat format = read_format(choices);
  EncoderSettings settings = read_settings(choices);
  const bool wrong = spoil(choices, format, settings);
  if (choices.below(32) == 1) settings.marks = read_marks(choices);
  auto encoder = fbs::Encoder::create(format, settings);
  if (wrong) {
    require(!encoder, "a setting out of range is taken");
    const ErrorCode code = encoder.error().code;
    require(code == ErrorCode::kInvalidArgument || code == ErrorCode::kTooLarge,
            "another error than its caller's");
    return 0;
  }
  require(encoder.has_value(), "a setting in its range is refused");
  Session(std::move(*encoder), format).run(choices);
  return 0;
}
