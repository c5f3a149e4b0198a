#include "tests/fuzz/bounded_decode.h"

#include <algorithm>

#include "decoder/stream/stream_decoder.h"
#include "tests/fuzz/fuzz_target.h"

namespace fbs::fuzz {
namespace {

class BoundedDecoding {
 public:
  explicit BoundedDecoding(std::span<const std::uint8_t> stream) : size_(stream.size()) {
    decoder_.count_motion_bits();
    decoder_.record_patterns();
    decoder_.feed(stream);
    decoder_.close();
  }

  DecodeTally run() {
    while (tally_.drawn < kMaxDrawnPictures && step()) continue;
    const ByteCount& b = decoder_.bytes();
    require(b.geometry + b.patterns + b.motion + b.sound + b.other == b.total, "bytes do not sum up");
    return tally_;
  }

 private:
  /// @return whether there is more
  bool step() {
    const auto status = decoder_.next();
    if (!status) {
      // Each error costs at least one byte.
      require(tally_.errors++ <= size_, "the decoder does not come to an end");
      require(status.error().code != ErrorCode::kInternal, "internal error");
      return true;
    }
    if (*status == DecodeStatus::kEnd) return false;
    require(*status == DecodeStatus::kPicture, "a closed stream asks for more");
    require(decoder_.duration() >= 1 && decoder_.duration() <= kMaxDuration, "a duration out of range");
    if (std::max(decoder_.format().width, decoder_.format().height) > kMaxDrawnSide) return false;
    if (decoder_.held())
      hold();
    else
      draw();
    return true;
  }

  void hold() {
    ++tally_.held;
    require(tally_.drawn > 0 && ++in_a_row_ <= kMaxHeldPictures, "too many pictures are held");
    if (in_a_row_ > 1) return;
    require(decoder_.render(again_).has_value() && again_ == picture_,
            "another picture than the last is held");
  }

  void draw() {
    ++tally_.drawn;
    in_a_row_ = 0;
    require(decoder_.render(picture_).has_value(), "an announced picture is not drawn");
    require(picture_.width() == decoder_.format().width && picture_.height() == decoder_.format().height,
            "a picture of another size");
  }

  std::size_t size_;
  StreamDecoder decoder_;
  Picture picture_, again_;
  std::size_t in_a_row_ = 0;  // held pictures
  DecodeTally tally_;
};

}  // namespace

DecodeTally decode_bounded(std::span<const std::uint8_t> stream) {
  return BoundedDecoding(stream).run();
}

}  // namespace fbs::fuzz
