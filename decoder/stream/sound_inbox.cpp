#include "decoder/stream/sound_inbox.h"

namespace fbs {

std::size_t memory_of(const std::vector<std::uint8_t>& frame) {
  constexpr std::size_t kOverhead = 64;  // of the vector and of what the allocator adds
  return kOverhead + frame.size();
}

std::size_t memory_of(const SoundGroup& group) {
  std::size_t sum = 0;
  for (const auto& frame : group.frames) sum += memory_of(frame);
  return sum;
}

Result<void> SoundInbox::add(SoundPart part) {
  if (!keeps_) return {};
  const std::size_t size = memory_of(part.group);
  if (size_ + size > kMaxSoundAhead)
    return fail(ErrorCode::kTooLarge, "too much sound comes before its pictures");
  size_ += size;
  parts_.push_back(std::move(part));
  return {};
}

}  // namespace fbs
