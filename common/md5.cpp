#include "common/md5.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace fbs {
namespace {

constexpr std::array<int, 16> kShifts = {7, 12, 17, 22, 5, 9, 14, 20, 4, 11, 16, 23, 6, 10, 15, 21};

// clang-format off
// [int(abs(math.sin(i + 1)) * 2**32) for i in range(64)]
constexpr std::array<std::uint32_t, 64> kSines = {
    0xd76aa478, 0xe8c7b756, 0x242070db, 0xc1bdceee, 0xf57c0faf, 0x4787c62a, 0xa8304613, 0xfd469501,
    0x698098d8, 0x8b44f7af, 0xffff5bb1, 0x895cd7be, 0x6b901122, 0xfd987193, 0xa679438e, 0x49b40821,
    0xf61e2562, 0xc040b340, 0x265e5a51, 0xe9b6c7aa, 0xd62f105d, 0x02441453, 0xd8a1e681, 0xe7d3fbc8,
    0x21e1cde6, 0xc33707d6, 0xf4d50d87, 0x455a14ed, 0xa9e3e905, 0xfcefa3f8, 0x676f02d9, 0x8d2a4c8a,
    0xfffa3942, 0x8771f681, 0x6d9d6122, 0xfde5380c, 0xa4beea44, 0x4bdecfa9, 0xf6bb4b60, 0xbebfbc70,
    0x289b7ec6, 0xeaa127fa, 0xd4ef3085, 0x04881d05, 0xd9d4d039, 0xe6db99e5, 0x1fa27cf8, 0xc4ac5665,
    0xf4292244, 0x432aff97, 0xab9423a7, 0xfc93a039, 0x655b59c3, 0x8f0ccc92, 0xffeff47d, 0x85845dd1,
    0x6fa87e4f, 0xfe2ce6e0, 0xa3014314, 0x4e0811a1, 0xf7537e82, 0xbd3af235, 0x2ad7d2bb, 0xeb86d391};
// clang-format on

}  // namespace

void Md5::block(const std::uint8_t* bytes) {
  std::array<std::uint32_t, 16> word;
  for (std::size_t i = 0; i < 16; ++i)
    word[i] =
        bytes[4 * i] | bytes[4 * i + 1] << 8 | bytes[4 * i + 2] << 16 | std::uint32_t{bytes[4 * i + 3]} << 24;
  auto [a, b, c, d] = state_;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::size_t round = i / 16;
    const std::uint32_t f = round == 0   ? (b & c) | (~b & d)
                            : round == 1 ? (d & b) | (~d & c)
                            : round == 2 ? b ^ c ^ d
                                         : c ^ (b | ~d);
    const std::size_t place = round == 0   ? i
                              : round == 1 ? (5 * i + 1) % 16
                              : round == 2 ? (3 * i + 5) % 16
                                           : 7 * i % 16;
    const std::uint32_t turned = std::rotl(a + f + kSines[i] + word[place], kShifts[4 * round + i % 4]);
    a = d;
    d = c;
    c = b;
    b += turned;
  }
  state_ = {state_[0] + a, state_[1] + b, state_[2] + c, state_[3] + d};
}

void Md5::add(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const std::size_t used = size_ % 64;
    const std::size_t take = std::min(bytes.size(), 64 - used);
    std::copy_n(bytes.begin(), take, buffer_.begin() + used);
    size_ += take;
    bytes = bytes.subspan(take);
    if (size_ % 64 == 0) block(buffer_.data());
  }
}

void Md5::add(const Picture& picture) {
  for (const Plane* plane : {&picture.y, &picture.u, &picture.v}) add(plane->samples);
}

std::string Md5::hex() {
  std::uint64_t bits = size_ * 8;
  add(std::array<std::uint8_t, 1>{0x80});
  while (size_ % 64 != 56) add(std::array<std::uint8_t, 1>{0});
  for (int i = 0; i < 8; ++i, bits >>= 8) add(std::array{static_cast<std::uint8_t>(bits)});
  std::string out;
  for (const std::uint32_t s : state_)
    for (int k = 0; k < 32; k += 8)
      for (const int nibble : {4, 0}) out += "0123456789abcdef"[s >> (k + nibble) & 15];
  return out;
}

}  // namespace fbs
