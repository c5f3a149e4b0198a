// The functions that the module fbs_av exports.

extern "C" {
#include <libavutil/avutil.h>
}

#include <string>

#include "cli/program/module.h"
#include "cli/video/av/av_png.h"
#include "cli/video/av/av_sink.h"
#include "cli/video/av/av_sound_source.h"
#include "cli/video/av/av_source.h"
#include "cli/video/video_modules.h"

FBS_MODULE_EXPORT void fbs_open_source(const std::string& input, const fbs::SourceOptions& options,
                                       fbs::Result<std::unique_ptr<fbs::VideoSource>>& source) {
  source = fbs::open_av_source(input, options);
}

FBS_MODULE_EXPORT void fbs_open_sound_source(const std::string& input, const fbs::SoundSourceOptions& options,
                                             fbs::Result<std::unique_ptr<fbs::SoundSource>>& source) {
  source = fbs::open_av_sound_source(input, options);
}

FBS_MODULE_EXPORT void fbs_open_sink(const std::string& output, const fbs::VideoFormat& format,
                                     const fbs::SinkOptions& options,
                                     fbs::Result<std::unique_ptr<fbs::VideoSink>>& sink) {
  sink = fbs::open_av_sink(output, format, options);
}

FBS_MODULE_EXPORT void fbs_encode_png(const fbs::RgbImage& image, int width, int height,
                                      fbs::Result<std::vector<std::uint8_t>>& png) {
  png = fbs::encode_png(image, width, height);
}

FBS_MODULE_EXPORT const char* fbs_module_libraries() {
  static const std::string text = std::string("FFmpeg ") + av_version_info();
  return text.c_str();
}
