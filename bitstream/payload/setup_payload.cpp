#include "bitstream/payload/setup_payload.h"

#include <algorithm>
#include <array>
#include <limits>

#include "bitstream/byte_io.h"

namespace fbs {
namespace {

constexpr std::uint8_t kFullRangeFlag = 1;
constexpr int kMatrixShift = 1;
constexpr std::uint8_t kMaxMatrix = static_cast<std::uint8_t>(ColourMatrix::kBt709);

// A number that does not fit becomes one that check_setup rejects.
std::int32_t to_int(std::uint64_t value) {
  return static_cast<std::int32_t>(std::min<std::uint64_t>(value, std::numeric_limits<std::int32_t>::max()));
}

// SPEC 4.1: numerator, denominator.
Result<Rational> read_rational(ByteReader& reader) {
  const std::uint64_t num = reader.varint();
  const std::uint64_t den = reader.varint();
  if (std::max(num, den) > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorCode::kInvalidStream, "setup has a ratio out of range");
  }
  return Rational{static_cast<std::uint32_t>(num), static_cast<std::uint32_t>(den)};
}

void write_rational(ByteWriter& writer, const Rational& ratio) {
  writer.varint(ratio.num);
  writer.varint(ratio.den);
}

void write_colour(ByteWriter& writer, const YuvColour& colour) {
  for (const std::uint8_t component : {colour.y, colour.u, colour.v}) writer.u8(component);
}

YuvColour read_colour(ByteReader& reader) {
  YuvColour colour;
  for (std::uint8_t* component : {&colour.y, &colour.u, &colour.v}) *component = reader.u8();
  return colour;
}

// In the order of SPEC 4.1.
template <class Steps>
auto in_order(Steps& steps) {
  return std::array{&steps.rotation, &steps.translation, &steps.log_scale, &steps.light, &steps.control};
}

// SPEC 4.1: bit 0 is the range, the others are the matrix.
Result<void> set_colour(VideoFormat& format, std::uint8_t colour) {
  if (colour >> kMatrixShift > kMaxMatrix) return fail(ErrorCode::kInvalidStream, "colour matrix is unknown");
  format.range = (colour & kFullRangeFlag) != 0 ? ColourRange::kFull : ColourRange::kLimited;
  format.matrix = static_cast<ColourMatrix>(colour >> kMatrixShift);
  return {};
}

// Errors of check_setup blame the caller; in a stream they mean kInvalidStream.
Error as_stream_error(Error error) {
  if (error.code == ErrorCode::kInvalidArgument) error.code = ErrorCode::kInvalidStream;
  return error;
}

bool is_rate(const Rational& rate) {
  return rate.num > 0 && rate.den > 0 && rate.num <= std::uint64_t{kMaxPicturesPerSecond} * rate.den;
}

bool is_step(std::int32_t step) {
  return step >= 1 && step <= kMaxStep;
}

}  // namespace

Result<void> check_setup(const Setup& setup) {
  if (setup.before.pictures > kMaxStreamPictures || setup.before.time > kMaxStreamTime)
    return fail(ErrorCode::kTooLarge, "too many pictures before the scene");
  if (!can_last(setup.before.pictures, setup.before.time))
    return fail(ErrorCode::kInvalidArgument, "pictures before the scene cannot take the time before it");
  const VideoFormat& f = setup.format;
  if (std::max(f.width, f.height) > kMaxPictureSize)
    return fail(ErrorCode::kTooLarge, "picture is too large");
  if (std::min(f.width, f.height) < kMinPictureSize) {
    return fail(ErrorCode::kInvalidArgument, "picture is too small");
  }
  if (!is_rate(f.frame_rate)) return fail(ErrorCode::kInvalidArgument, "frame rate is out of range");
  if (f.pixel_aspect.den == 0) return fail(ErrorCode::kInvalidArgument, "pixel aspect has no denominator");
  if (f.range != ColourRange::kLimited && f.range != ColourRange::kFull) {
    return fail(ErrorCode::kInvalidArgument, "colour range is unknown");
  }
  if (static_cast<std::uint8_t>(f.matrix) > kMaxMatrix) {
    return fail(ErrorCode::kInvalidArgument, "colour matrix is unknown");
  }
  for (const std::int32_t* step : in_order(setup.steps))
    if (!is_step(*step)) return fail(ErrorCode::kInvalidArgument, "quantiser step is out of range");
  if ((setup.parts & ~kAllParts) != 0 || (setup.parts & mask_of(PartId::kPose)) == 0)
    return fail(ErrorCode::kInvalidArgument, "parts of the state are out of range");
  if (setup.patterns < 1) return fail(ErrorCode::kInvalidArgument, "number of patterns is out of range");
  if (setup.patterns > kMaxPatterns) return fail(ErrorCode::kTooLarge, "too many patterns");
  if (setup.contrast < kMinContrast || setup.contrast > kContrastOne)
    return fail(ErrorCode::kInvalidArgument, "contrast of patterns is out of range");
  if (setup.chroma_contrast < kContrastOne || setup.chroma_contrast > kMaxChromaContrast ||
      setup.chroma_contrast % 2 != 0)
    return fail(ErrorCode::kInvalidArgument, "chroma contrast of patterns is out of range");
  return {};
}

Result<std::vector<std::uint8_t>> encode_setup(const Setup& setup) {
  if (auto checked = check_setup(setup); !checked) return fail(checked.error());
  std::vector<std::uint8_t> payload;
  ByteWriter writer(payload);
  const bool keeps = setup.keeps != SceneKeeping::kNone;
  writer.varint(keeps ? kFormatVersion : kVersionWithoutReturns);
  writer.u8(kGenericHeadId);
  writer.varint(setup.before.pictures);
  writer.varint(setup.before.time);
  writer.varint(static_cast<std::uint64_t>(setup.format.width));
  writer.varint(static_cast<std::uint64_t>(setup.format.height));
  write_rational(writer, setup.format.frame_rate);
  write_rational(writer, setup.format.pixel_aspect);
  writer.u8(static_cast<std::uint8_t>((setup.format.range == ColourRange::kFull ? kFullRangeFlag : 0) |
                                      static_cast<int>(setup.format.matrix) << kMatrixShift));
  for (const std::int32_t* step : in_order(setup.steps)) writer.varint(static_cast<std::uint64_t>(*step));
  writer.varint(setup.parts >> 1);
  for (const YuvColour& c : {setup.mouth.upper, setup.mouth.lower}) write_colour(writer, c);
  const bool has_chroma = keeps || setup.chroma_contrast > kContrastOne;
  const bool has_contrast = has_chroma || setup.contrast < kContrastOne;
  if (setup.patterns > 1 || has_contrast) writer.varint(static_cast<std::uint64_t>(setup.patterns));
  if (has_contrast) writer.u8(static_cast<std::uint8_t>(kContrastOne - setup.contrast));
  if (has_chroma) writer.u8(static_cast<std::uint8_t>((setup.chroma_contrast - kContrastOne) / 2));
  if (keeps) writer.u8(static_cast<std::uint8_t>(setup.keeps));
  return payload;
}

Result<Setup> decode_setup(std::span<const std::uint8_t> payload) {
  ByteReader reader(payload);

  // SPEC 4.1: check the version first, since the layout of another version is unknown.
  const std::uint64_t version = reader.varint();
  if (reader.ok() && version != 0 && version != kVersionWithoutReturns && version != kFormatVersion) {
    return fail(ErrorCode::kUnsupported, version > kFormatVersion ? "stream is of a newer format version"
                                                                  : "stream is of an older format version");
  }
  const std::uint8_t head = reader.u8();
  if (reader.ok() && head != kGenericHeadId) return fail(ErrorCode::kUnsupported, "generic head is unknown");

  Setup setup;
  setup.before.pictures = reader.varint();
  setup.before.time = reader.varint();
  setup.format.width = to_int(reader.varint());
  setup.format.height = to_int(reader.varint());
  const auto frame_rate = read_rational(reader);
  const auto pixel_aspect = read_rational(reader);
  const std::uint8_t colour = reader.u8();
  for (std::int32_t* step : in_order(setup.steps)) *step = to_int(reader.varint());
  const std::uint64_t parts = reader.varint();
  setup.mouth.upper = read_colour(reader);
  setup.mouth.lower = read_colour(reader);
  if (reader.remaining() > 0) setup.patterns = to_int(reader.varint());
  if (reader.remaining() > 0) setup.contrast = kContrastOne - reader.u8();
  if (reader.remaining() > 0) setup.chroma_contrast = kContrastOne + 2 * reader.u8();
  const std::uint8_t keeps = version == kFormatVersion && reader.remaining() > 0 ? reader.u8() : 0;

  if (reader.past_end()) return fail(ErrorCode::kTruncated, "setup packet ends early", reader.offset());
  if (reader.malformed() || version == 0) return fail(ErrorCode::kInvalidStream, "setup packet is damaged");
  if (!frame_rate) return fail(frame_rate.error());
  if (!pixel_aspect) return fail(pixel_aspect.error());
  if (auto set = set_colour(setup.format, colour); !set) return fail(set.error());
  if (parts > kAllParts >> 1) return fail(ErrorCode::kInvalidStream, "a part of the state is unknown");

  if (keeps > static_cast<std::uint8_t>(SceneKeeping::kAndPresent))
    return fail(ErrorCode::kInvalidStream, "what becomes of earlier scenes is unknown");

  setup.keeps = static_cast<SceneKeeping>(keeps);
  setup.format.frame_rate = *frame_rate;
  setup.format.pixel_aspect = *pixel_aspect;
  setup.parts = static_cast<PartMask>(parts << 1 | 1);
  if (auto checked = check_setup(setup); !checked) return fail(as_stream_error(checked.error()));
  return setup;
}

}  // namespace fbs
