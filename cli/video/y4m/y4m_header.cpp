#include <array>
#include <charconv>
#include <limits>
#include <optional>

#include "cli/video/timestamps.h"
#include "cli/video/y4m/y4m.h"

namespace fbs {
namespace {

constexpr std::string_view kMagic = "YUV4MPEG2";
constexpr std::size_t kMaxWrittenHeader = 95;  // ffmpeg's limit; it rejects longer lines

template <class Integer>
std::optional<Integer> parse_number(std::string_view text) {
  Integer value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Parses "30000:1001"; 0:0 stands for unknown.
std::optional<Rational> parse_ratio(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto num = parse_number<std::uint32_t>(text.substr(0, colon));
  const auto den = parse_number<std::uint32_t>(text.substr(colon + 1));
  if (!num || !den) return std::nullopt;
  return Rational{*num, *den};
}

struct ChromaName {
  std::string_view name;
  Y4mLayout layout;
};

// Where one name is a prefix of another, the longer one comes first.
constexpr std::array<ChromaName, 9> kChromaNames{{
    {"420jpeg", {true, false, 1, 1, 8}},
    {"420mpeg2", {true, false, 1, 1, 8}},
    {"420paldv", {true, false, 1, 1, 8}},
    {"420", {true, false, 1, 1, 8}},
    {"411", {true, false, 2, 0, 8}},
    {"422", {true, false, 1, 0, 8}},
    {"444alpha", {true, true, 0, 0, 8}},
    {"444", {true, false, 0, 0, 8}},
    {"mono", {false, false, 0, 0, 8}},
}};

/// Parses "420jpeg", "422p10", "mono12".
std::optional<Y4mLayout> parse_chroma(std::string_view text) {
  for (const ChromaName& known : kChromaNames) {
    if (!text.starts_with(known.name)) continue;
    std::string_view depth = text.substr(known.name.size());
    if (depth.empty()) return known.layout;
    if (depth[0] == 'p') depth.remove_prefix(1);
    const auto bits = parse_number<int>(depth);
    if (!bits || *bits < 8 || *bits > 16) return std::nullopt;
    Y4mLayout layout = known.layout;
    layout.bits = *bits;
    return layout;
  }
  return std::nullopt;
}

void parse_extension(std::string_view text, VideoFormat& format) {
  if (text == "COLORRANGE=FULL") format.range = ColourRange::kFull;
  if (text == "COLORRANGE=LIMITED") format.range = ColourRange::kLimited;
  if (text == "MATRIX=BT601") format.matrix = ColourMatrix::kBt601;
  if (text == "MATRIX=BT709") format.matrix = ColourMatrix::kBt709;
}

/// Text from a file, made safe for an error message.
std::string quoted(std::string_view text) {
  constexpr std::size_t kMaxQuote = 24;
  std::string quote(text.substr(0, kMaxQuote));
  for (char& c : quote) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "'" + quote + "'";
}

/// Parses one tag, its letter first. @return false when its value cannot be read
bool parse_tag(std::string_view tag, Y4mHeader& header) {
  const std::string_view value = tag.substr(1);
  VideoFormat& format = header.format;
  switch (tag[0]) {
    case 'W':
    case 'H': {
      const auto side = parse_number<int>(value);
      (tag[0] == 'W' ? format.width : format.height) = side.value_or(0);
      return side.has_value();
    }
    case 'F': {
      const auto rate = parse_ratio(value);
      if (!rate || *rate == Rational{0, 0}) return rate.has_value();
      format.frame_rate = *rate;
      return plausible_rate(*rate);
    }
    case 'A': {
      const auto aspect = parse_ratio(value);
      if (aspect && aspect->num != 0 && aspect->den != 0) format.pixel_aspect = *aspect;
      return aspect.has_value();
    }
    case 'X':
      parse_extension(value, format);
      return true;
    default:  // 'I', interlacing, does not change the samples; other tags are not ours
      return true;
  }
}

}  // namespace

Result<Y4mHeader> parse_y4m_header(std::string_view line) {
  if (!line.starts_with(kMagic)) return fail(ErrorCode::kInvalidStream, "not a Y4M stream");
  line.remove_prefix(kMagic.size());

  Y4mHeader header;
  header.format.pixel_aspect = {0, 1};
  while (!line.empty()) {
    if (line[0] != ' ') return fail(ErrorCode::kInvalidStream, "damaged Y4M header");
    line.remove_prefix(1);
    const std::string_view tag = line.substr(0, line.find(' '));
    line.remove_prefix(tag.size());
    if (tag.empty()) continue;
    if (tag[0] == 'C') {
      const auto layout = parse_chroma(tag.substr(1));
      if (!layout) return fail(ErrorCode::kUnsupported, "unknown Y4M chroma format " + quoted(tag.substr(1)));
      header.layout = *layout;
    } else if (!parse_tag(tag, header)) {
      return fail(ErrorCode::kInvalidStream, "damaged Y4M header at " + quoted(tag));
    }
  }
  if (header.format.width <= 0 || header.format.height <= 0) {
    return fail(ErrorCode::kInvalidStream, "Y4M header without width and height");
  }
  return header;
}

std::string y4m_header(const VideoFormat& format) {
  const auto ratio = [](Rational r) { return std::to_string(r.num) + ":" + std::to_string(r.den); };
  const bool aspect_known = format.pixel_aspect.num != 0 && format.pixel_aspect.den != 0;
  std::string line(kMagic);
  line += " W" + std::to_string(format.width) + " H" + std::to_string(format.height);
  line += " F" + ratio(format.frame_rate) + " Ip A" + (aspect_known ? ratio(format.pixel_aspect) : "0:0");
  line += " C420mpeg2";
  line += format.range == ColourRange::kFull ? " XCOLORRANGE=FULL" : " XCOLORRANGE=LIMITED";
  std::string matrix;
  if (format.matrix == ColourMatrix::kBt601) matrix = " XMATRIX=BT601";
  if (format.matrix == ColourMatrix::kBt709) matrix = " XMATRIX=BT709";
  if (line.size() + matrix.size() <= kMaxWrittenHeader) line += matrix;
  return line;
}

}  // namespace fbs
