// Whole bytes in and out: fixed-size numbers, LEB128 varints and spans. SPEC 2.1.
//
// Only this file moves a cursor over input bytes. Reading past the end returns zeros and sets a flag that
// stays set; parsers read a whole structure and check ok() once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fbs {

/// Appends to a vector that is owned by the caller and outlives the writer.
class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::uint8_t>& out) : out_(out) {}

  void u8(std::uint8_t value) { out_.push_back(value); }

  /// High byte first.
  void u16(std::uint16_t value) {
    u8(static_cast<std::uint8_t>(value >> 8));
    u8(static_cast<std::uint8_t>(value));
  }

  /// LEB128: seven bits a byte, low bits first, high bit set on all but the last; 1..10 bytes.
  void varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) u8(static_cast<std::uint8_t>(value | 0x80));
    u8(static_cast<std::uint8_t>(value));
  }

  void bytes(std::span<const std::uint8_t> data) { out_.insert(out_.end(), data.begin(), data.end()); }

 private:
  std::vector<std::uint8_t>& out_;
};

/// Reads bytes that are owned by the caller and outlive the reader.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> data) : data_(data) {}

  [[nodiscard]] std::uint8_t u8() {
    if (!has(1)) return 0;
    return data_[offset_++];
  }

  /// High byte first.
  [[nodiscard]] std::uint16_t u16() {
    const unsigned high = u8();
    return static_cast<std::uint16_t>(high << 8 | u8());
  }

  /// A varint of at most 64 bits in its shortest form; anything else sets malformed() and returns 0.
  [[nodiscard]] std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const std::uint8_t byte = u8();
      const std::uint64_t bits = byte & 0x7Fu;
      if (shift == 63 && bits > 1) break;
      value |= bits << shift;
      if (byte < 0x80) {
        const bool padded = byte == 0 && shift > 0;
        if (padded) malformed_ = malformed_ || !past_end_;
        return ok() ? value : 0;
      }
    }
    malformed_ = true;
    return 0;
  }

  /// The next `size` bytes without copying; empty, and past_end() set, when fewer remain.
  [[nodiscard]] std::span<const std::uint8_t> bytes(std::size_t size) {
    if (!has(size)) return {};
    const auto taken = data_.subspan(offset_, size);
    offset_ += size;
    return taken;
  }

  /// Everything that remains; may be empty.
  [[nodiscard]] std::span<const std::uint8_t> rest() { return bytes(remaining()); }

  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] std::size_t remaining() const { return data_.size() - offset_; }
  [[nodiscard]] bool past_end() const { return past_end_; }
  [[nodiscard]] bool malformed() const { return malformed_; }
  [[nodiscard]] bool ok() const { return !past_end_ && !malformed_; }

 private:
  [[nodiscard]] bool has(std::size_t size) {
    const bool enough = size <= data_.size() - offset_;
    if (!enough) {
      past_end_ = true;
      offset_ = data_.size();
    }
    return enough;
  }

  std::span<const std::uint8_t> data_;
  std::size_t offset_ = 0;  // invariant: offset_ <= data_.size()
  bool past_end_ = false;
  bool malformed_ = false;
};

}  // namespace fbs
