// A stream through the calls of fbs/fbs.h: in pieces of any size, with other calls between them, it gives the
// same result as in one piece. The order of the calls is drawn from a checksum of the input.
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "common/md5.h"
#include "fbs/fbs.h"
#include "tests/fuzz/bounded_decode.h"
#include "tests/fuzz/byte_mutator.h"

namespace {

using fbs::fuzz::Bytes;
using fbs::fuzz::Random;

struct Close {
  void operator()(fbs_decoder* decoder) const { fbs_decoder_close(&decoder); }
};

/// The answer of fbs_decoder_next(), and the picture if it announced one.
struct Answer {
  fbs_status status = FBS_OK;
  std::uint64_t number = 0, time = 0, error_offset = 0;
  std::uint32_t duration = 0;
  std::string picture;  ///< MD5

  friend bool operator==(const Answer&, const Answer&) = default;
};

std::uint32_t check_of(std::span<const std::uint8_t> bytes) {
  std::uint32_t check = 2166136261U;  // FNV-1a
  for (const std::uint8_t byte : bytes) check = (check ^ byte) * 16777619U;
  return check;
}

class Session {
 public:
  explicit Session(std::span<const std::uint8_t> stream) : stream_(stream) {
    fbs_decoder_settings settings;
    fbs_decoder_default_settings(&settings, sizeof settings);
    settings.max_pixels = std::uint64_t{fbs::fuzz::kMaxDrawnSide} * fbs::fuzz::kMaxDrawnSide;
    fbs_decoder* decoder = nullptr;
    require(fbs_decoder_open(&decoder, &settings) == FBS_OK, "a decoder is not opened");
    decoder_.reset(decoder);
  }

  /// @param largest  piece, bytes
  std::vector<Answer> run(std::size_t largest, Random& random) {
    std::vector<Answer> answers;
    for (bool more = true; more;) {
      more = feed(std::min(largest, stream_.size() - at_));
      while (answers.size() < kMostAnswers && next(answers)) misuse(random);
      if (answers.size() == kMostAnswers || answers.size() > stream_.size()) break;
      if (largest > 1 && more) largest = 1 + random() % (2 * largest);
    }
    return answers;
  }

 private:
  static constexpr std::size_t kMostAnswers = 40;

  fbs_decoder* get() { return decoder_.get(); }

  /// @return whether the decoder may need more
  bool feed(std::size_t size) {
    require(fbs_decoder_feed(get(), stream_.data() + at_, size) == FBS_OK, "bytes are not taken");
    at_ += size;
    if (at_ < stream_.size()) return true;
    require(fbs_decoder_finish(get()) == FBS_OK, "the end is not taken");
    require(fbs_decoder_feed(get(), stream_.data(), stream_.size() + 1) == FBS_ERROR_ARGUMENT,
            "bytes after the end");
    return false;
  }

  /// @return whether there was an answer
  bool next(std::vector<Answer>& answers) {
    fbs_picture_info info{};
    const fbs_status status = fbs_decoder_next(get(), &info);
    require(status != FBS_ERROR_INTERNAL && status != FBS_ERROR_ARGUMENT,
            "an error that is not the stream's");
    require(status != FBS_END || at_ == stream_.size(), "an end that nobody announced");
    if (status == FBS_NEED_DATA || status == FBS_END) return false;
    Answer answer{.status = status,
                  .number = info.number,
                  .time = info.time,
                  .error_offset = 0,
                  .duration = info.duration,
                  .picture = {}};
    if (status == FBS_OK)
      answer.picture = picture();
    else
      answer.error_offset = fbs_decoder_error_offset(get());
    answers.push_back(answer);
    return true;
  }

  /// The picture as drawn by the decoder and into rows of another length from the bottom up: they must be the
  /// same.
  std::string picture() {
    fbs_const_picture given;
    require(fbs_decoder_get_picture(get(), &given) == FBS_OK, "an announced picture is not given");
    std::array<Bytes, 3> memory;
    fbs_picture drawn{given.width, given.height, {}, {}};
    for (int k = 0; k < 3; ++k) {
      const auto [width, height] = size_of(given, k);
      const std::size_t stride = width + 5;
      memory[static_cast<std::size_t>(k)].resize(stride * height);
      drawn.data[k] = memory[static_cast<std::size_t>(k)].data() + stride * (height - 1);
      drawn.stride[k] = -static_cast<std::ptrdiff_t>(stride);
    }
    const Bytes before = samples(given);
    require(fbs_decoder_draw(get(), &drawn) == FBS_OK, "an announced picture is not drawn");
    require(before == samples({drawn.width,
                               drawn.height,
                               {drawn.data[0], drawn.data[1], drawn.data[2]},
                               {drawn.stride[0], drawn.stride[1], drawn.stride[2]}}),
            "a picture drawn into other memory is another");
    fbs::Md5 md5;
    md5.add(before);
    return md5.hex();
  }

  static std::array<std::size_t, 2> size_of(const fbs_const_picture& p, int plane) {
    if (plane == 0) return {p.width, p.height};
    return {(std::size_t{p.width} + 1) / 2, (std::size_t{p.height} + 1) / 2};
  }

  static Bytes samples(const fbs_const_picture& p) {
    Bytes out;
    for (int k = 0; k < 3; ++k) {
      const auto [width, height] = size_of(p, k);
      for (std::size_t y = 0; y < height; ++y) {
        const std::uint8_t* const row = p.data[k] + static_cast<std::ptrdiff_t>(y) * p.stride[k];
        out.insert(out.end(), row, row + width);
      }
    }
    return out;
  }

  /// Calls that change nothing.
  void misuse(Random& random) {
    if (random() % 4 != 0) return;
    fbs_format format{};
    const fbs_status known = fbs_decoder_get_format(get(), &format);
    require(known == FBS_OK || known == FBS_NEED_DATA, "the format is not told");
    fbs_face_state state;
    std::array<fbs_landmark, FBS_LANDMARKS> landmarks;
    std::array<fbs_vertex, FBS_MAX_VERTICES> vertices;
    std::size_t count = vertices.size();
    const fbs_status told = fbs_decoder_get_state(get(), &state);
    require(told != FBS_ERROR_INTERNAL, "internal error");
    require(fbs_decoder_get_landmarks(get(), landmarks.data()) == told, "a state without landmarks");
    require(fbs_decoder_get_vertices(get(), vertices.data(), &count) == told, "a state without vertices");
    std::array<float, FBS_BLENDSHAPES> weights;
    require(fbs_decoder_get_blendshapes(get(), weights.data()) == told, "a state without blendshapes");
    if (told == FBS_OK) draw_edited(random, format);
    const fbs_picture wrong{format.width + 1, format.height, {}, {}};
    require(fbs_decoder_draw(get(), &wrong) == FBS_ERROR_ARGUMENT, "a picture without memory is drawn");
    require(fbs_decoder_feed(get(), nullptr, 1) == FBS_ERROR_ARGUMENT, "no bytes are taken");
  }

  void draw_edited(Random& random, const fbs_format& format) {
    const auto any = [&](float limit) { return limit * (static_cast<float>(random() % 2001) / 1000 - 1); };
    const fbs_face_edit edit{any(12), any(18), any(15), any(1), any(1), any(1), any(1)};
    fbs_face_state state;
    require(fbs_decoder_set_edit(get(), &edit) == FBS_OK && fbs_decoder_get_state(get(), &state) == FBS_OK,
            "a state is not edited");
    Bytes memory(std::size_t{format.width} * format.height);
    const auto stride = static_cast<std::ptrdiff_t>(format.width);
    const fbs_picture drawn{
        format.width, format.height, {memory.data(), memory.data(), memory.data()}, {stride, stride, stride}};
    require(fbs_decoder_draw_state(get(), &state, &drawn) == FBS_OK, "an edited state is not drawn");
    require(fbs_decoder_draw(get(), &drawn) == FBS_OK, "an edited picture is not drawn");
    require(fbs_decoder_set_edit(get(), nullptr) == FBS_OK, "an edit stays");
  }

  std::span<const std::uint8_t> stream_;
  std::unique_ptr<fbs_decoder, Close> decoder_;
  std::size_t at_ = 0;
};

void find_scenes(std::span<const std::uint8_t> stream, Random& random) {
  for (const std::uint64_t time :
       {std::uint64_t{0}, std::uint64_t{random()}, std::numeric_limits<std::uint64_t>::max()}) {
    fbs_scene scene;
    const fbs_status status = fbs_find_scene(stream.data(), stream.size(), time, &scene);
    require(status == FBS_OK || status == FBS_END || stream.empty(), "no answer where a scene is");
    require(status != FBS_OK || scene.offset < stream.size(), "a scene behind the stream");
  }
}

}  // namespace

std::vector<Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return {stream};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> stream(data, size);
  Random random(check_of(stream));
  const auto whole = Session(stream).run(size, random);
  require(whole == Session(stream).run(1 + random() % 64, random),
          "pieces give another answer than the whole");
  find_scenes(stream, random);
  return 0;
}
