// encode_frames OUT.fbs: encodes pictures that are in memory. Here the generated talker makes them; a camera
// or another decoder would do as well.
#include <cstdio>
#include <fstream>

#include "encoder/encoder.h"
#include "samples/talker/talker_render.h"

namespace {

constexpr int kPictures = 75;

int report(const fbs::Error& error) {
  std::fprintf(stderr, "%s\n", error.text.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: encode_frames OUT.fbs\n"), 2;
  fbs::talker::Settings talker_settings;
  talker_settings.width = 176;
  talker_settings.height = 144;
  talker_settings.frame_count = kPictures;
  const fbs::talker::Talker talker(talker_settings);

  fbs::VideoFormat format;  // of all pictures
  format.width = talker_settings.width;
  format.height = talker_settings.height;
  format.frame_rate = talker_settings.frame_rate;
  fbs::EncoderSettings settings;
  settings.quality = 60;  // or settings.bitrate, in kbit/s

  auto encoder = fbs::Encoder::create(format, settings);
  if (!encoder) return report(encoder.error());
  std::ofstream file(argv[1], std::ios::binary);
  const auto send = [&] {  // take() is often empty: the encoder collects pictures before it writes
    const auto bytes = encoder->take();
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  for (int n = 0; n < kPictures; ++n) {
    const fbs::Picture picture = talker.picture(n);  // planar YCbCr, 4:2:0
    if (const auto pushed = encoder->push(picture); !pushed) return report(pushed.error());
    send();
  }
  if (const auto finished = encoder->finish(); !finished) return report(finished.error());
  send();
  file.close();
  return file ? 0 : (std::fprintf(stderr, "%s: cannot write\n", argv[1]), 1);
}
