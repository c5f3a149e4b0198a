#include "bitstream/motion/motion_bit_counter.h"

#include "bitstream/entropy/bit_counter.h"

namespace fbs {

PartBitsX256 MotionBitCounter::count(const MotionGroup& group) {
  if (group.key) reference_.reset();
  PartBitsX256 bits{};
  BitCounter counter;
  std::uint64_t before = 0;
  code_body(counter, reference_, group, [&](std::size_t part) {
    bits[part] = counter.bits_x256() - before;
    before = counter.bits_x256();
  });
  return bits;
}

}  // namespace fbs
