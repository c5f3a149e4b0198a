// round_trip WIDTH HEIGHT RATE: encodes the pictures on standard input and writes what a decoder makes of
// them:
//
//     ffmpeg -i talk.mkv -f rawvideo -pix_fmt yuv420p - | round_trip 352 288 25 |
//       ffplay -f rawvideo -video_size 352x288 -
//
// Needs libfbs_encoder. round_trip.go and round_trip.py do the same in Go and in Python.
#include <cstdio>
#include <cstdlib>
#include <fbs/encoder.hpp>
#include <fbs/fbs.hpp>
#include <vector>

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes encode(fbs_encoder_settings settings) {
  const std::uint32_t width = settings.format.width, height = settings.format.height;
  const std::ptrdiff_t chroma_width = (width + 1) / 2;
  const std::size_t luma = std::size_t{width} * height, chroma = chroma_width * std::size_t{(height + 1) / 2};
  Bytes samples(luma + 2 * chroma), stream;
  const std::uint8_t* const y = samples.data();
  const fbs_const_picture picture = {
      width, height, {y, y + luma, y + luma + chroma}, {std::ptrdiff_t{width}, chroma_width, chroma_width}};

  fbs::Encoder encoder(settings);
  const auto pull = [&] {
    while (const auto packet = encoder.pull())
      stream.insert(stream.end(), packet->data, packet->data + packet->size);
  };
  for (; std::fread(samples.data(), 1, samples.size(), stdin) == samples.size(); pull())
    encoder.push(picture);
  encoder.finish();
  pull();
  return stream;
}

void decode(const Bytes& stream) {
  fbs::Decoder decoder;
  decoder.feed(stream.data(), stream.size());
  decoder.finish();
  while (decoder.next() == FBS_OK) {
    const fbs_const_picture picture = decoder.picture();
    for (int plane = 0; plane < 3; ++plane) {
      const std::uint32_t width = plane == 0 ? picture.width : (picture.width + 1) / 2;
      const std::uint32_t height = plane == 0 ? picture.height : (picture.height + 1) / 2;
      for (std::uint32_t row = 0; row < height; ++row)
        std::fwrite(picture.data[plane] + row * picture.stride[plane], 1, width, stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) return std::fprintf(stderr, "usage: round_trip WIDTH HEIGHT RATE < IN.yuv > OUT.yuv\n"), 2;
  auto settings = fbs::Encoder::default_settings();
  auto print_warning = [](fbs_log_level level, const char* text) {
    if (level <= FBS_LOG_WARNING) std::fprintf(stderr, "%s\n", text);
  };
  fbs::log_to(settings, print_warning);
  settings.format.width = static_cast<std::uint32_t>(std::atoi(argv[1]));
  settings.format.height = static_cast<std::uint32_t>(std::atoi(argv[2]));
  settings.format.frame_rate_num = static_cast<std::uint32_t>(std::atoi(argv[3]));
  const Bytes stream = encode(settings);
  std::fprintf(stderr, "%zu bytes\n", stream.size());
  decode(stream);
  return 0;
} catch (const fbs::Error& error) {
  return std::fprintf(stderr, "round_trip: %s\n", error.what()), 1;
}
