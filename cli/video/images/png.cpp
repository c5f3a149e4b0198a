#include "cli/video/images/png.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace fbs {

Result<std::vector<std::uint8_t>> encode_png(const RgbImage& image) {
  constexpr const char* kName = "texture.png";
  const auto writer = OIIO::ImageOutput::create(kName);
  if (!writer) return fail(ErrorCode::kUnsupported, "OpenImageIO writes no PNG: " + OIIO::geterror());
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("png:compressionLevel", 9);
  std::vector<std::uint8_t> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const bool done = writer->set_ioproxy(&memory) && writer->open(kName, spec) &&
                    writer->write_image(OIIO::TypeDesc::UINT8, image.samples.data()) && writer->close();
  if (!done) return fail(ErrorCode::kInternal, "OpenImageIO cannot encode a PNG: " + writer->geterror());
  return bytes;
}

}  // namespace fbs
