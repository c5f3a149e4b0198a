#include "bitstream/motion/motion_bit_counter.h"

#include "bitstream/entropy/bit_counter.h"

namespace fbs {

PartBitsX256 MotionBitCounter::count(const MotionGroup& group) {
  if (group.key) reference_.reset();
  reference_.last = group.anchor;
  PartBitsX256 bits{};
  BitCounter counter;
  std::uint64_t before = 0;
  code_body(counter, reference_, group, [&](std::size_t part) {
    bits[part] = counter.bits_x256() - before;
    before = counter.bits_x256();
  });
  reference_.end(group);
  return bits;
}

}  // namespace fbs
