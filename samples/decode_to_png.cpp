// decode_to_png STREAM FOLDER: decodes a stream and writes each picture to FOLDER as a PNG file.
// Needs only the decoder library, and stb to write PNG.
#include <stb_image_write.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "decoder/stream_decoder.h"

namespace {

/// Three bytes per pixel: red, green, blue. The format says which YCbCr the video has.
std::vector<std::uint8_t> to_rgb(const fbs::Picture& picture, const fbs::VideoFormat& format) {
  const bool full = format.range == fbs::ColourRange::kFull;
  const bool bt709 = format.matrix == fbs::ColourMatrix::kBt709;
  const double kr = bt709 ? 0.2126 : 0.299, kb = bt709 ? 0.0722 : 0.114, kg = 1 - kr - kb;
  const double black = full ? 0 : 16;
  const double luma_gain = full ? 1 : 255.0 / 219, chroma_gain = full ? 1 : 255.0 / 224;
  const auto sample = [](double v) { return static_cast<std::uint8_t>(std::clamp(v + 0.5, 0.0, 255.0)); };
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * picture.y.samples.size());
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const int cx = x / 2, cy = y / 2;  // one chroma sample for 2 x 2 pixels
      const double luma = (picture.y.row(y)[x] - black) * luma_gain;
      const double cb = (picture.u.row(cy)[cx] - 128) * chroma_gain;
      const double cr = (picture.v.row(cy)[cx] - 128) * chroma_gain;
      const double red = luma + 2 * (1 - kr) * cr, blue = luma + 2 * (1 - kb) * cb;
      const double green = (luma - kr * red - kb * blue) / kg;
      rgb.insert(rgb.end(), {sample(red), sample(green), sample(blue)});
    }
  return rgb;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: decode_to_png STREAM FOLDER\n"), 2;
  std::ifstream file(argv[1], std::ios::binary);
  const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});

  fbs::StreamDecoder decoder;
  decoder.feed({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});  // or piece by piece
  decoder.close();  // no more bytes will come
  fbs::Picture picture;
  for (;;) {
    const auto status = decoder.next();
    if (!status) return std::fprintf(stderr, "%s: %s\n", argv[1], status.error().text.c_str()), 1;
    if (*status == fbs::DecodeStatus::kEnd) return 0;
    if (auto drawn = decoder.render(picture); !drawn) return 1;
    const std::string name = std::string(argv[2]) + "/" + std::to_string(decoder.pictures()) + ".png";
    const auto rgb = to_rgb(picture, decoder.format());
    const int width = picture.width(), height = picture.height();
    if (stbi_write_png(name.c_str(), width, height, 3, rgb.data(), 3 * width) == 0)
      return std::fprintf(stderr, "%s: cannot write\n", name.c_str()), 1;
  }
}
