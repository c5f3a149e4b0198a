#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <exception>
#include <utility>
#include <vector>

#include "cli/files/atomic_file.h"
#include "cli/files/number_pattern.h"
#include "cli/video/colour.h"
#include "cli/video/images/image_files.h"

namespace fbs {
namespace {

constexpr int kPngCompression = 4;  // zlib level: nearly the size of level 9 in a third of the time

class ImageSink final : public VideoSink {
 public:
  ImageSink(NumberPattern pattern, std::unique_ptr<OIIO::ImageOutput> writer, const VideoFormat& format)
      : pattern_(std::move(pattern)), writer_(std::move(writer)), format_(format) {}

  /// Creates the first file at once, so that an unwritable folder is reported before any work is done.
  Result<void> open() { return create_next(); }

  Result<void> write(const Picture& picture, std::int64_t /*pts*/) override {
    if (picture.width() != format_.width || picture.height() != format_.height) {
      return fail(ErrorCode::kInvalidArgument, "picture size differs from the video's");
    }
    if (written_ == files_.size()) {
      if (auto created = create_next(); !created) return created;
    }
    AtomicFile& file = files_[written_];
    try {
      if (auto encoded = encode(picture, file.name()); !encoded) return encoded;
    } catch (const std::exception& problem) {
      return fail(ErrorCode::kIo, "cannot write " + file.name() + ": " + problem.what());
    }
    if (auto stored = file.write(bytes_); !stored) return stored;
    if (auto closed = file.close(); !closed) return closed;
    if (written_ > 0) file.unlock();  // the first file keeps other processes away from the set
    ++written_;
    return {};
  }

  [[nodiscard]] bool replaced_leftover() const override { return replaced_leftover_; }

  Result<void> finish() override {
    files_.erase(files_.begin() + static_cast<std::ptrdiff_t>(written_), files_.end());
    for (AtomicFile& file : files_) {
      if (auto committed = file.commit(); !committed) return committed;
    }
    return {};
  }

 private:
  Result<void> create_next() {
    auto file = AtomicFile::create(pattern_.name(static_cast<std::int64_t>(files_.size()) + 1));
    if (!file) return fail(file.error());
    replaced_leftover_ = replaced_leftover_ || file->replaced_leftover();
    files_.push_back(std::move(*file));
    return {};
  }

  /// Encodes the image file in memory, into bytes_.
  Result<void> encode(const Picture& picture, const std::string& name) {
    const RgbImage image = rgb_from_picture(picture, format_.range, format_.matrix);
    OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("png:compressionLevel", kPngCompression);
    const Rational aspect = format_.pixel_aspect;
    if (aspect.num != 0 && aspect.den != 0 && aspect.num != aspect.den) {
      spec.attribute("PixelAspectRatio", static_cast<float>(aspect.num) / static_cast<float>(aspect.den));
    }
    bytes_.clear();
    OIIO::Filesystem::IOVecOutput memory(bytes_);
    const bool done = writer_->set_ioproxy(&memory) && writer_->open(name, spec) &&
                      writer_->write_image(OIIO::TypeDesc::UINT8, image.samples.data()) && writer_->close();
    if (done) return {};
    return fail(ErrorCode::kIo, "cannot write " + name + ": " + writer_->geterror());
  }

  NumberPattern pattern_;
  std::unique_ptr<OIIO::ImageOutput> writer_;
  VideoFormat format_;
  std::vector<AtomicFile> files_;  ///< the last one is open, waiting for its picture
  std::size_t written_ = 0;
  bool replaced_leftover_ = false;
  std::vector<unsigned char> bytes_;
};

}  // namespace

Result<std::unique_ptr<VideoSink>> open_image_sink(const std::string& output, const VideoFormat& format) {
  OIIO::attribute("threads", 1);
  auto pattern = parse_number_pattern(output);
  if (!pattern) {
    return fail(ErrorCode::kUnsupported,
                "cannot write " + output + ": the name needs one number, such as %05d");
  }
  auto writer = OIIO::ImageOutput::create(pattern->name(1));
  if (!writer || !writer->supports("ioproxy")) {
    OIIO::geterror();
    return fail(ErrorCode::kUnsupported, "cannot write " + output + ": unknown image format; use .png");
  }
  auto sink = std::make_unique<ImageSink>(std::move(*pattern), std::move(writer), format);
  if (auto opened = sink->open(); !opened) return fail(opened.error());
  return sink;
}

}  // namespace fbs
