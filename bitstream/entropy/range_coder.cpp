#include "bitstream/entropy/range_coder.h"

#include <algorithm>
#include <cassert>

namespace fbs {
namespace {

constexpr std::uint32_t kMinRange = 1u << 24;  // below this a byte is output
constexpr int kCodeBytes = 4;

// Where the interval is split: zeros get the lower part.
std::uint32_t split(std::uint32_t range, std::uint32_t zero) {
  assert(zero > 0 && zero < kProbabilityOne);
  return static_cast<std::uint32_t>(std::uint64_t{range} * zero >> 16);
}

}  // namespace

// Adds one in the last place: the bytes so far are a fraction in base 256.
void RangeEncoder::carry() {
  std::size_t i = bytes_.size();
  while (i > 0 && ++bytes_[--i] == 0) {
  }
}

void RangeEncoder::normalise() {
  while (range_ < kMinRange) {
    bytes_.push_back(static_cast<std::uint8_t>(low_ >> 24));
    low_ <<= 8;
    range_ <<= 8;
  }
}

bool RangeEncoder::raw_bit(std::uint32_t zero, bool value) {
  const std::uint32_t bound = split(range_, zero);
  if (value) {
    low_ += bound;
    if (low_ < bound) carry();
    range_ -= bound;
  } else {
    range_ = bound;
  }
  normalise();
  return value;
}

std::uint32_t RangeEncoder::bypass(int count, std::uint32_t value) {
  assert(count >= 0 && count < 32);
  for (int i = count - 1; i >= 0; --i) raw_bit(kProbabilityOne / 2, (value >> i & 1) != 0);
  return value;
}

std::vector<std::uint8_t> RangeEncoder::finish() {
  // The decoder will have read this many bytes, of which kMaxVirtualBytes may be virtual.
  const std::size_t read = bytes_.size() + kCodeBytes;

  // Any number in [low, low + range) is valid: take the one with the fewest significant bytes.
  const std::uint64_t low = low_;
  for (int size = 0; size <= kCodeBytes; ++size) {
    const std::uint64_t unit = std::uint64_t{1} << 8 * (kCodeBytes - size);
    const std::uint64_t number = (low + unit - 1) / unit * unit;
    if (number >= low + range_) continue;
    if (number >> 32 != 0) carry();
    for (int i = 0; i < size; ++i)
      bytes_.push_back(static_cast<std::uint8_t>(number >> 8 * (kCodeBytes - 1 - i)));
    break;
  }

  const std::size_t least = read > kMaxVirtualBytes ? read - kMaxVirtualBytes : 0;
  while (!bytes_.empty() && bytes_.back() == 0) bytes_.pop_back();
  bytes_.resize(std::max(bytes_.size(), least), 0);
  return std::move(bytes_);
}

std::vector<std::uint8_t> RangeEncoder::finish_open() {
  static_assert(kOpenEndBytes == kCodeBytes - 1);
  // The interval is at least kMinRange wide: it has a number whose lower bytes are zeros.
  const std::uint64_t number = (std::uint64_t{low_} + kMinRange - 1) / kMinRange;
  if (number >> 8 != 0) carry();
  bytes_.push_back(static_cast<std::uint8_t>(number));
  return std::move(bytes_);
}

RangeDecoder::RangeDecoder(std::span<const std::uint8_t> data) : data_(data) {
  for (int i = 0; i < kCodeBytes; ++i) code_ = code_ << 8 | next_byte();
  valid_ = code_ < range_;
}

std::uint8_t RangeDecoder::next_byte() {
  if (offset_ < data_.size()) return data_[offset_++];
  if (virtual_bytes_ <= kMaxVirtualBytes) ++virtual_bytes_;
  return 0;
}

void RangeDecoder::normalise() {
  while (range_ < kMinRange) {
    code_ = code_ << 8 | next_byte();
    range_ <<= 8;
  }
}

bool RangeDecoder::raw_bit(std::uint32_t zero, bool) {
  const std::uint32_t bound = split(range_, zero);
  const bool value = code_ >= bound;
  if (value) {
    code_ -= bound;
    range_ -= bound;
  } else {
    range_ = bound;
  }
  normalise();
  return value;
}

std::uint32_t RangeDecoder::bypass(int count, std::uint32_t) {
  assert(count >= 0 && count < 32);
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i)
    value = value << 1 | static_cast<std::uint32_t>(raw_bit(kProbabilityOne / 2));
  return value;
}

}  // namespace fbs
