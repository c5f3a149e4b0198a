// The bytes of a pattern's AV1 frame in a range code. SPEC 4.4.
//
// The headers of a scene's frames are much alike and have no adaptive code of their own: their bits are coded
// in contexts. The rest, which AV1 has compressed, is coded as it is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "bitstream/entropy/adaptive_bit.h"
#include "bitstream/entropy/bit_counter.h"

namespace fbs {

/// Bytes at the start of a frame that have contexts. 16 to 22 bytes are within 2 % of the best saving (16
/// streams, 300 patterns); beyond, tile data teaches the contexts noise.
inline constexpr std::size_t kHeaderBytes = 19;

/// Kinds of frames by their first bits: hidden, shown, or behind a sequence header.
inline constexpr std::size_t kFrameKinds = 3;

/// By kind, place of the bit, and the bit before it.
using FrameContexts = std::array<std::array<std::array<AdaptiveBit, 2>, 8 * kHeaderBytes>, kFrameKinds>;

/// A place in a frame, and what selects the context there.
struct FramePlace {
  std::size_t bit = 0;  ///< counted from the first of the frame
  std::size_t kind = 0;
  bool before = false;  ///< value of the last bit
};

/// Codes the next bit of a frame's first kHeaderBytes.
template <class Coder>
bool code_header_bit(Coder& coder, FrameContexts& contexts, FramePlace& place, bool value) {
  // Low bit of the type of the first OBU: set in a sequence header, not in a frame.
  constexpr std::size_t kTypeBit = 4;
  // show_frame, in a frame without a sequence header.
  constexpr std::size_t kShowBit = 11;
  value = coder.bit(contexts[place.kind][place.bit][place.before ? 1 : 0], value);
  place.before = value;
  if (place.bit == kTypeBit && value) place.kind = 2;
  if (place.bit == kShowBit && value && place.kind == 0) place.kind = 1;
  ++place.bit;
  return value;
}

/// Codes the next byte of a frame.
template <class Coder>
std::uint8_t code_frame_byte(Coder& coder, FrameContexts& contexts, FramePlace& place, std::uint8_t value) {
  if (place.bit >= 8 * kHeaderBytes) return static_cast<std::uint8_t>(coder.bypass(8, value));
  unsigned read = 0;
  for (int k = 7; k >= 0; --k)
    read = read << 1 | unsigned{code_header_bit(coder, contexts, place, (value >> k & 1) != 0)};
  return static_cast<std::uint8_t>(read);
}

/// Contexts that have seen one frame of each kind, as libaom writes them: a scene of few patterns has each
/// kind only once or twice.
inline FrameContexts initial_frame_contexts() {
  // The more frequent value of each bit in the same streams.
  constexpr std::array<std::array<std::uint8_t, kHeaderBytes>, kFrameKinds> kExamples = {
      {{0x30, 0x28, 0x02, 0x40, 0x01, 0x00, 0x00, 0x83, 0x4C, 0x50, 0x19, 0x48, 0xA2, 0x45, 0x98, 0x90, 0x07,
        0x80, 0x00},
       {0x30, 0x30, 0x02, 0x40, 0x0F, 0x00, 0x81, 0x06, 0x99, 0xC0, 0x06, 0x80, 0x40, 0x8B, 0x18, 0x00, 0x07,
        0x00, 0xC0},
       {0x0A, 0x0B, 0x00, 0x00, 0x00, 0x04, 0xCD, 0x7E, 0x7F, 0xFD, 0x7F, 0xC0, 0x20, 0x30, 0x10, 0x00, 0x97,
        0xE0, 0x1A}}};
  FrameContexts contexts;
  BitCounter learner;
  for (const auto& example : kExamples) {
    FramePlace place;
    for (const std::uint8_t byte : example) code_frame_byte(learner, contexts, place, byte);
  }
  return contexts;
}

}  // namespace fbs
