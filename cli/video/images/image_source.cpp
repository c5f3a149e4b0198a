#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include "cli/video/colour.h"
#include "cli/video/images/image_files.h"
#include "cli/video/images/image_sequence.h"
#include "cli/video/picture_size.h"
#include "cli/video/timestamps.h"

namespace fbs {
namespace {

constexpr std::uint32_t kAspectPrecision = 10000;  // OpenImageIO gives the pixel aspect as a float

/// OpenImageIO's list of suffixes: "bmp:bmp,dib;png:png;...".
bool is_image_suffix(const std::string& suffix) {
  static const std::string known = OIIO::get_string_attribute("extension_list");
  std::istringstream formats(known);
  for (std::string format; std::getline(formats, format, ';');) {
    std::istringstream suffixes(format.substr(format.find(':') + 1));
    for (std::string one; std::getline(suffixes, one, ',');) {
      if (one == suffix) return true;
    }
  }
  return false;
}

Rational pixel_aspect(const OIIO::ImageSpec& spec) {
  const float aspect = spec.get_float_attribute("PixelAspectRatio", 1.0F);
  if (!(aspect > 0.01F && aspect < 100.0F) || aspect == 1.0F) return {1, 1};
  return {static_cast<std::uint32_t>(std::lround(aspect * kAspectPrecision)), kAspectPrecision};
}

class ImageSource final : public VideoSource {
 public:
  ImageSource(std::vector<std::string> files, Rational rate) : files_(std::move(files)) {
    format_.frame_rate = rate;
    format_.matrix = ColourMatrix::kBt601;
  }

  /// Takes the size from the first image.
  Result<void> open() {
    const auto image = OIIO::ImageInput::open(files_[0]);
    if (!image) return error(files_[0]);
    format_.width = image->spec().width;
    format_.height = image->spec().height;
    format_.pixel_aspect = pixel_aspect(image->spec());
    return check_picture_size(files_[0], format_.width, format_.height);
  }

  [[nodiscard]] const VideoFormat& format() const override { return format_; }

  Result<std::optional<TimedPicture>> next() override {
    if (index_ == files_.size()) return std::nullopt;
    const std::string& file = files_[index_];
    try {
      auto picture = read(file);
      if (!picture) return fail(picture.error());
      const auto number = static_cast<std::int64_t>(index_++);
      return TimedPicture{std::move(*picture), regular_pts(number, format_.frame_rate)};
    } catch (const std::exception& problem) {
      return fail(ErrorCode::kInvalidStream, "cannot read " + file + ": " + problem.what());
    }
  }

  [[nodiscard]] bool has_constant_rate() const override { return true; }
  [[nodiscard]] std::optional<std::int64_t> frame_count_estimate() const override {
    return static_cast<std::int64_t>(files_.size());
  }
  [[nodiscard]] std::vector<std::string> notes() const override {
    return was_transparent_ ? std::vector<std::string>{kOverBlack} : std::vector<std::string>{};
  }

 private:
  [[nodiscard]] static tl::unexpected<Error> error(const std::string& file) {
    std::string reason = OIIO::geterror();
    reason = reason.substr(0, reason.find('\n'));
    return fail(ErrorCode::kIo, "cannot read " + file + ": " + (reason.empty() ? "damaged image" : reason));
  }

  Result<Picture> read(const std::string& file) {
    const auto image = OIIO::ImageInput::open(file);
    if (!image) return error(file);
    const OIIO::ImageSpec& spec = image->spec();
    if (spec.width != format_.width || spec.height != format_.height) {
      return size_change(file, format_, spec.width, spec.height);
    }
    return spec.format.basesize() > 1 ? read<std::uint16_t>(file, *image) : read<std::uint8_t>(file, *image);
  }

  template <class Sample>
  Result<Picture> read(const std::string& file, OIIO::ImageInput& image) {
    const OIIO::ImageSpec& spec = image.spec();
    const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    const bool has_alpha = spec.alpha_channel == 3;
    const int channels = has_alpha ? 4 : spec.nchannels >= 3 ? 3 : 1;
    std::vector<Sample> samples(pixels * static_cast<std::size_t>(channels));
    const OIIO::TypeDesc type = sizeof(Sample) > 1 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
    if (!image.read_image(0, 0, 0, channels, type, samples.data())) {
      const std::string reason = image.geterror();
      return fail(ErrorCode::kInvalidStream,
                  "cannot read " + file + ": " + (reason.empty() ? "damaged image" : reason));
    }
    if (channels == 1) {
      std::vector<Sample> rgb(3 * pixels);
      for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = samples[i / 3];
      samples = std::move(rgb);
    }
    if (has_alpha) drop_alpha(samples);
    return picture_from_rgb(std::span<const Sample>(samples), spec.width, spec.height, format_.range,
                            format_.matrix);
  }

  /// OpenImageIO has multiplied the colours by it: they are shown over black.
  template <class Sample>
  void drop_alpha(std::vector<Sample>& samples) {
    const std::size_t pixels = samples.size() / 4;
    for (std::size_t i = 0; i < pixels; ++i) {
      was_transparent_ = was_transparent_ || samples[4 * i + 3] < std::numeric_limits<Sample>::max();
      std::copy_n(samples.begin() + static_cast<std::ptrdiff_t>(4 * i), 3,
                  samples.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    samples.resize(3 * pixels);
  }

  std::vector<std::string> files_;
  std::size_t index_ = 0;
  bool was_transparent_ = false;
  VideoFormat format_;
};

}  // namespace

Result<std::unique_ptr<VideoSource>> open_image_source(const std::string& input,
                                                       const SourceOptions& options) {
  OIIO::attribute("threads", 1);
  auto files = image_sequence_files(input, is_image_suffix);
  if (!files) return fail(files.error());
  auto source = std::make_unique<ImageSource>(std::move(*files), options.sequence_rate);
  if (auto opened = source->open(); !opened) return fail(opened.error());
  return source;
}

}  // namespace fbs
