#include "cli/decode/thumbnail.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "cli/program/module.h"
#include "cli/stream/stream_file.h"
#include "cli/video/colour.h"
#include "cli/video/video_modules.h"
#include "decoder/export/face_table.h"
#include "decoder/scene/scene_face.h"

namespace fbs::cli {
namespace {

constexpr std::uint64_t kMostPictures = 500;  ///< that are looked at: twenty seconds or so
constexpr double kFrontalDeg = 15;            ///< most pitch and yaw
constexpr double kOpenEyes = 0.35;            ///< most weight of eyeBlink

double weight_of(const FaceNumbers& face, const char* name) {
  const auto& names = blendshape_names();
  const auto at = std::ranges::find(names, name) - names.begin();
  return face.blendshapes.at(static_cast<std::size_t>(at));
}

bool looks_good(const FaceNumbers& face) {
  const auto& [pitch, yaw, roll] = face.rotation_deg;
  return std::abs(pitch) <= kFrontalDeg && std::abs(yaw) <= kFrontalDeg &&
         weight_of(face, "eyeBlinkLeft") <= kOpenEyes && weight_of(face, "eyeBlinkRight") <= kOpenEyes;
}

/// How well the current picture would do: 0 without a face, 1 with one, 2 a good one.
int merit_of(const StreamDecoder& decoder, FaceMeasure& measure) {
  const SceneGeometry* const head = face_of(decoder.scene());
  if (head == nullptr || decoder.quality() != PictureQuality::kExact) return 0;
  return looks_good(measure(head->geometry(), decoder.state())) ? 2 : 1;
}

/// Only pictures that are better than the last one are drawn.
Result<Picture> choose(StreamFile& file) {
  Picture chosen;
  int best = -1;
  FaceMeasure measure;
  for (std::uint64_t n = 0; n < kMostPictures && best < 2; ++n) {
    const auto status = file.next();
    if (!status && chosen.empty()) return fail(status.error());
    if (!status || *status == DecodeStatus::kEnd) break;
    const int merit = merit_of(file.decoder(), measure);
    if (merit <= best) continue;
    if (auto drawn = file.decoder().render(chosen); !drawn) return fail(drawn.error());
    best = merit;
  }
  if (chosen.empty()) return fail(ErrorCode::kInvalidStream, file.name() + ": contains no pictures");
  return chosen;
}

/// Width and height of a picture with square pixels in a square of this side; it is never enlarged.
std::array<int, 2> size_within(const VideoFormat& format, int side) {
  const Rational aspect = format.pixel_aspect;
  const bool known = aspect.num != 0 && aspect.den != 0;
  const double width = format.width * (known ? 1.0 * aspect.num / aspect.den : 1.0);
  const double scale = std::min(1.0, side / std::max<double>(width, format.height));
  const auto scaled = [&](double length) {
    return std::clamp(static_cast<int>(std::lround(scale * length)), 1, side);
  };
  return {scaled(width), scaled(format.height)};
}

/// Not an AtomicFile: Tumbler (Xfce) makes the file, keeps it open, and reads from there.
Result<void> write_in_place(const std::string& name, std::span<const std::uint8_t> bytes) {
  std::FILE* const file = std::fopen(name.c_str(), "wb");
  bool written = file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if (file != nullptr) written = std::fclose(file) == 0 && written;
  if (written) return {};
  return fail(ErrorCode::kIo, "cannot write " + name + ": " + std::generic_category().message(errno));
}

}  // namespace

Result<void> write_thumbnail(const DecodeArguments& a) {
  const auto encode_png = load_module_function<EncodePngFunction>(kAvModule, kEncodePngSymbol);
  if (!encode_png) return fail(encode_png.error());
  auto file = StreamFile::open(a.input);
  if (!file) return fail(file.error());
  if (a.from > 0)
    if (auto sought = file->seek(ticks(a.from)); !sought) return sought;
  const auto picture = choose(*file);
  if (!picture) return fail(picture.error());
  const VideoFormat& format = file->decoder().format();
  const auto [width, height] = size_within(format, a.thumbnail);
  Result<std::vector<std::uint8_t>> png;
  (*encode_png)(rgb_from_picture(*picture, format.range, format.matrix), width, height, png);
  if (!png) return fail(png.error());
  return write_in_place(a.output, *png);
}

}  // namespace fbs::cli
