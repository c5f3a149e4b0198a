#include "tests/fuzz/setup_fields.h"

#include <array>
#include <string_view>

#include "bitstream/byte_io.h"
#include "bitstream/payload/setup_payload.h"

namespace fbs::fuzz {
namespace {

// SPEC 4.1, in order; v: varint, b: byte. Version, head, position, size, rate and aspect, colour, steps,
// parts, mouth colours, then the optional patterns, contrasts and what is kept.
constexpr std::string_view kLayout = "vbvvvvvvvvbvvvvvvbbbbbbvbbb";
constexpr std::size_t kRequired = kLayout.size() - 4;
constexpr std::size_t kWidth = 4, kHeight = 5, kPatterns = kRequired, kKeeps = kRequired + 3;

/// Numbers at the limits of some field, and beyond.
constexpr std::uint64_t kOne = 1;
constexpr auto kLimits = std::to_array<std::uint64_t>({0,
                                                       1,
                                                       2,
                                                       3,
                                                       5,
                                                       kMinPictureSize - 1,
                                                       kMinPictureSize,
                                                       kMinPictureSize + 1,
                                                       66,
                                                       96,
                                                       127,
                                                       128,
                                                       129,
                                                       160,
                                                       255,
                                                       256,
                                                       257,
                                                       1000,
                                                       1001,
                                                       4096,
                                                       kMaxPictureSize,
                                                       kMaxPictureSize + 1,
                                                       kMaxStep,
                                                       kMaxStep + 1,
                                                       kMaxDuration,
                                                       (kOne << 31) - 1,
                                                       kOne << 31,
                                                       (kOne << 32) - 1,
                                                       kOne << 32,
                                                       kMaxStreamPictures,
                                                       kMaxStreamPictures + 1,
                                                       kMaxStreamTime,
                                                       kMaxStreamTime + 1,
                                                       ~std::uint64_t{0}});

}  // namespace

SetupFields read_setup_fields(std::span<const std::uint8_t> payload) {
  SetupFields out;
  ByteReader reader(payload);
  std::size_t read = 0;
  for (const char kind : kLayout) {
    const std::uint64_t value = kind == 'b' ? reader.u8() : reader.varint();
    if (!reader.ok()) break;
    out.values.push_back(value);
    read = reader.offset();
  }
  out.rest.assign(payload.begin() + static_cast<std::ptrdiff_t>(read), payload.end());
  return out;
}

Bytes write_setup_fields(const SetupFields& fields) {
  Bytes out;
  ByteWriter writer(out);
  for (std::size_t i = 0; i < fields.values.size(); ++i) {
    if (kLayout[i] == 'b')
      writer.u8(static_cast<std::uint8_t>(fields.values[i]));
    else
      writer.varint(fields.values[i]);
  }
  writer.bytes(fields.rest);
  return out;
}

void change_setup(SetupFields& fields, Random& random) {
  auto& values = fields.values;
  if (values.empty()) return;
  if (values.size() >= kRequired && random() % 4 == 0) {
    // Three slots more or less matter more than a limit of something else.
    values.resize(kRequired + random() % 5);
    if (values.size() > kPatterns) values[kPatterns] = 1 + random() % (kMaxPatterns + 1);
    for (std::size_t i = kPatterns + 1; i < values.size(); ++i) values[i] = random() % 130;
    if (values.size() > kKeeps) values[kKeeps] = random() % 4;
    return;
  }
  const std::size_t at = random() % values.size();
  switch (random() % 4) {
    case 0:
      values[at] += random() % 5 - 2ULL;
      break;
    case 1:
      values[at] = values[random() % values.size()];
      break;
    default:
      values[at] = kLimits[random() % kLimits.size()];
      break;
  }
  // Large pictures are not drawn: most setups stay small.
  if ((at == kWidth || at == kHeight) && random() % 4 != 0) values[at] = kMinPictureSize + random() % 97;
}

}  // namespace fbs::fuzz
