// MD5 (RFC 1321), for test vectors and `fbs decode --md5`: detects differences, offers no security.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "common/picture.h"

namespace fbs {

class Md5 {
 public:
  void add(std::span<const std::uint8_t> bytes);
  /// The planes Y, U, V of a picture, rows without padding.
  void add(const Picture& picture);

  /// 32 hexadecimal digits. Call once, after all bytes.
  [[nodiscard]] std::string hex();

 private:
  void block(const std::uint8_t* bytes);

  std::array<std::uint32_t, 4> state_ = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
  std::array<std::uint8_t, 64> buffer_{};
  std::uint64_t size_ = 0;
};

}  // namespace fbs
