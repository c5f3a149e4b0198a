// Binary range coder: encoder and decoder. SPEC 2.2.
//
// Method: G. N. N. Martin, Range encoding, 1979, in the carry-propagating form of LZMA. Differs: no leading
// zero byte; the interval is split with 16-bit probabilities by an exact product; the end is as short as the
// last interval allows, since the decoder reads zeros past the end.
//
// RangeEncoder, RangeDecoder and BitCounter (bit_counter.h) have the same interface, so that one template
// describes the writing, reading and counting of a structure:
//
//   template <class Coder> void code(Coder& coder, Contexts& c, Thing& t) {
//     t.flag = coder.bit(c.flag, t.flag);   // writes t.flag, reads it, or counts its bits
//   }
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/entropy/adaptive_bit.h"

namespace fbs {

/// The decoder reads at most this many bytes of zeros past the end; the encoder keeps within that.
inline constexpr std::size_t kMaxVirtualBytes = 16;

/// In a code with an open end, the last element ends once the decoder has read this many bytes of zeros past
/// the end. One byte beyond the encoder's always gives a number in the last interval, and the decoder is four
/// bytes ahead.
inline constexpr std::size_t kOpenEndBytes = 3;

class RangeEncoder {
 public:
  static constexpr bool kReads = false;

  /// Codes `value` with the probability `zero` (1/65536, 1..65535) of a zero. Returns `value`.
  bool raw_bit(std::uint32_t zero, bool value);

  /// Codes `value` in a context, which adapts to it. Returns `value`.
  bool bit(AdaptiveBit& context, bool value) {
    raw_bit(context.zero(), value);
    context.update(value);
    return value;
  }

  /// Codes the low `count` bits (0..31) of `value`, high bit first, one bit each. Returns `value`.
  std::uint32_t bypass(int count, std::uint32_t value);

  /// Ends the code and returns its bytes, the fewest from which a RangeDecoder reads every bit back; none
  /// when all bits were likely. Call once, after all bits.
  [[nodiscard]] std::vector<std::uint8_t> finish();

  /// Ends a code in place of finish(), so that RangeDecoder::past_open_end() becomes true at the bits after
  /// which written() last changed.
  [[nodiscard]] std::vector<std::uint8_t> finish_open();

  /// Bytes so far, without the end that finish() adds.
  [[nodiscard]] std::size_t written() const { return bytes_.size(); }

 private:
  void carry();
  void normalise();

  std::vector<std::uint8_t> bytes_;
  std::uint32_t low_ = 0;
  std::uint32_t range_ = 0xFFFFFFFF;
};

class RangeDecoder {
 public:
  static constexpr bool kReads = true;

  /// @param data  the whole code, owned by the caller
  explicit RangeDecoder(std::span<const std::uint8_t> data);

  /// Returns the bit that was coded with this probability. The second argument is ignored.
  bool raw_bit(std::uint32_t zero, bool = false);
  bool bit(AdaptiveBit& context, bool = false) {
    const bool value = raw_bit(context.zero());
    context.update(value);
    return value;
  }
  std::uint32_t bypass(int count, std::uint32_t = 0);

  /// False after more than kMaxVirtualBytes were read past the end, or when no encoder writes such bytes.
  /// Stays false.
  [[nodiscard]] bool ok() const { return valid_ && virtual_bytes_ <= kMaxVirtualBytes; }

  /// True when the last element of a code with an open end is complete.
  [[nodiscard]] bool past_open_end() const { return virtual_bytes_ >= kOpenEndBytes; }

  /// True when every byte has been read, as required once all is decoded.
  [[nodiscard]] bool at_end() const { return offset_ == data_.size(); }

 private:
  std::uint8_t next_byte();
  void normalise();

  std::span<const std::uint8_t> data_;
  std::size_t offset_ = 0;         // invariant: offset_ <= data_.size()
  std::size_t virtual_bytes_ = 0;  // zeros read past the end, counted up to kMaxVirtualBytes + 1
  std::uint32_t code_ = 0;         // invariant while valid_: code_ < range_
  std::uint32_t range_ = 0xFFFFFFFF;
  bool valid_ = true;
};

}  // namespace fbs
