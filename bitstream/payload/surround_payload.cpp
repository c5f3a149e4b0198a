#include "bitstream/payload/surround_payload.h"

#include <algorithm>
#include <array>

#include "bitstream/byte_io.h"
#include "bitstream/entropy/adaptive_bit.h"
#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

constexpr int kValues = kFollowOne + 1;

struct Contexts {
  std::array<AdaptiveBit, 8> differs;                              // by which neighbours are equal
  std::array<std::array<AdaptiveBit, kValues - 2>, kValues> next;  // by prediction and place among the others
};

// The neighbours of a value that are coded before it; a missing one takes the value of the nearest. SPEC 4.3.
struct Neighbours {
  int left, up, up_left, up_right;
};

Neighbours neighbours_of(const std::vector<std::uint8_t>& values, int width, int x, int y) {
  const auto at = [&](int px, int py) -> int { return values[py * width + px]; };
  if (x == 0 && y == 0) return {0, 0, 0, 0};
  if (y == 0) return {at(x - 1, 0), at(x - 1, 0), at(x - 1, 0), at(x - 1, 0)};
  const int up = at(x, y - 1);
  const int up_right = x + 1 < width ? at(x + 1, y - 1) : up;
  if (x == 0) return {up, up, up, up_right};
  return {at(x - 1, y), up, at(x - 1, y - 1), up_right};
}

// Median edge detector, as in JPEG-LS (Weinberger, Seroussi, Sapiro, The LOCO-I lossless image compression
// algorithm, 2000, section III.A).
int predict(const Neighbours& n) {
  const int low = std::min(n.left, n.up);
  const int high = std::max(n.left, n.up);
  return std::clamp(n.left + n.up - n.up_left, low, high);
}

// Codes whether the value differs from the prediction; if so, asks each other value in rising order, the last
// being implied.
template <class Coder>
int code_value(Coder& coder, Contexts& contexts, const Neighbours& n, int value) {
  const int predicted = predict(n);
  const int equal = (n.left == n.up ? 1 : 0) | (n.up == n.up_left ? 2 : 0) | (n.up == n.up_right ? 4 : 0);
  if (!coder.bit(contexts.differs[equal], value != predicted)) return predicted;
  auto& next = contexts.next[predicted];
  const int last = predicted == kFollowOne ? kFollowOne - 1 : kFollowOne;
  std::size_t place = 0;
  for (int candidate = 0; candidate < last; ++candidate) {
    if (candidate == predicted) continue;
    if (!coder.bit(next[place++], value != candidate)) return candidate;
  }
  return last;
}

/// Codes one layer of the map. Where `head` is not null and has kFollowOne, the value is zero and not coded.
template <class Coder>
void code_layer(Coder& coder, const SurroundMap& map, const std::vector<std::uint8_t>* head,
                std::vector<std::uint8_t>& values) {
  Contexts contexts;
  std::size_t i = 0;
  for (int y = 0; y <= map.rows; ++y) {
    for (int x = 0; x <= map.columns; ++x, ++i) {
      const bool implied = head != nullptr && (*head)[i] == kFollowOne;
      values[i] = implied ? std::uint8_t{0}
                          : static_cast<std::uint8_t>(code_value(
                                coder, contexts, neighbours_of(values, map.columns + 1, x, y), values[i]));
    }
  }
}

template <class Coder>
void code_values(Coder& coder, SurroundMap& map) {
  code_layer(coder, map, nullptr, map.head);
  AdaptiveBit any_body;
  const bool any =
      coder.bit(any_body, std::any_of(map.body.begin(), map.body.end(), [](auto v) { return v != 0; }));
  if (any) code_layer(coder, map, &map.head, map.body);
}

std::size_t point_count(const SurroundMap& map) {
  return (map.columns + 1) * (map.rows + 1);
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_surround(const SurroundMap& map) {
  if (std::min(map.columns, map.rows) < 1 || std::max(map.columns, map.rows) > kMaxSurroundCells) {
    return fail(ErrorCode::kInvalidArgument, "surround has 1 to 128 columns and rows");
  }
  const auto in_range = [](std::uint8_t value) { return value <= kFollowOne; };
  const auto valid = [&](const std::vector<std::uint8_t>& layer) {
    return layer.size() == point_count(map) && std::all_of(layer.begin(), layer.end(), in_range);
  };
  bool apart = valid(map.head) && valid(map.body);
  for (std::size_t i = 0; apart && i < point_count(map); ++i)
    apart = map.head[i] < kFollowOne || map.body[i] == 0;
  if (!apart) {
    return fail(ErrorCode::kInvalidArgument, "surround has values out of range or not one for each point");
  }
  std::vector<std::uint8_t> payload;
  ByteWriter writer(payload);
  writer.varint(static_cast<std::uint64_t>(map.columns));
  writer.varint(static_cast<std::uint64_t>(map.rows));
  RangeEncoder encoder;
  SurroundMap coded = map;
  code_values(encoder, coded);
  writer.bytes(encoder.finish());
  return payload;
}

Result<SurroundMap> decode_surround(std::span<const std::uint8_t> payload) {
  // SPEC 4.3
  ByteReader reader(payload);
  const std::uint64_t columns = reader.varint();
  const std::uint64_t rows = reader.varint();
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "surround packet ends early");
  if (reader.malformed() || std::min(columns, rows) < 1) {
    return fail(ErrorCode::kInvalidStream, "surround packet is damaged");
  }
  if (std::max(columns, rows) > kMaxSurroundCells) return fail(ErrorCode::kTooLarge, "surround is too large");

  SurroundMap map{static_cast<std::int32_t>(columns), static_cast<std::int32_t>(rows), {}, {}};
  map.head.assign(point_count(map), 0);
  map.body.assign(point_count(map), 0);
  RangeDecoder decoder(reader.rest());
  code_values(decoder, map);
  if (!decoder.ok()) return fail(ErrorCode::kTruncated, "surround packet ends early", payload.size());
  if (!decoder.at_end()) return fail(ErrorCode::kInvalidStream, "surround packet has excess bytes");
  return map;
}

}  // namespace fbs
