// The functions that the module fbs_image exports. OpenImageIO may throw; no exception leaves this file.

#include <OpenImageIO/imageio.h>

#include <exception>
#include <string>

#include "cli/program/module.h"
#include "cli/video/images/image_files.h"
#include "cli/video/video_modules.h"

FBS_MODULE_EXPORT void fbs_open_source(const std::string& input, const fbs::SourceOptions& options,
                                       fbs::Result<std::unique_ptr<fbs::VideoSource>>& source) {
  try {
    source = fbs::open_image_source(input, options);
  } catch (const std::exception& problem) {
    source = fbs::fail(fbs::ErrorCode::kIo, "cannot read " + input + ": " + problem.what());
  }
}

FBS_MODULE_EXPORT void fbs_open_sink(const std::string& output, const fbs::VideoFormat& format,
                                     const fbs::SinkOptions& /*options*/,
                                     fbs::Result<std::unique_ptr<fbs::VideoSink>>& sink) {
  try {
    sink = fbs::open_image_sink(output, format);
  } catch (const std::exception& problem) {
    sink = fbs::fail(fbs::ErrorCode::kIo, "cannot write " + output + ": " + problem.what());
  }
}

FBS_MODULE_EXPORT void fbs_read_image(const std::string& name, const fbs::VideoFormat& format,
                                      fbs::Result<fbs::Picture>& picture) {
  try {
    picture = fbs::read_still_image(name, format);
  } catch (const std::exception& problem) {
    picture = fbs::fail(fbs::ErrorCode::kIo, "cannot read " + name + ": " + problem.what());
  }
}

FBS_MODULE_EXPORT const char* fbs_module_libraries() {
  static const int version = OIIO::openimageio_version();  // 20407 is 2.4.7
  static const std::string text = "OpenImageIO " + std::to_string(version / 10000) + "." +
                                  std::to_string(version / 100 % 100) + "." + std::to_string(version % 100);
  return text.c_str();
}
