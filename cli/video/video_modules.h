// The interface between the program and its video modules: the names of the modules and of their functions.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/video/colour.h"
#include "cli/video/sound_source.h"
#include "cli/video/video_sink.h"
#include "cli/video/video_source.h"

namespace fbs {

inline constexpr const char* kAvModule = "fbs_av";  ///< libav: files, sound, H.264 output, PNG in memory
inline constexpr const char* kImageModule = "fbs_image";    ///< OpenImageIO: image sequences
inline constexpr const char* kCameraModule = "fbs_camera";  ///< OpenCV: cameras

inline constexpr const char* kOpenSourceSymbol = "fbs_open_source";
inline constexpr const char* kOpenSinkSymbol = "fbs_open_sink";
inline constexpr const char* kOpenSoundSourceSymbol = "fbs_open_sound_source";  ///< in kAvModule

/// Sets `source`: a function with C linkage cannot return it.
using OpenSourceFunction = void(const std::string& input, const SourceOptions& options,
                                Result<std::unique_ptr<VideoSource>>& source);

using OpenSoundSourceFunction = void(const std::string& input, const SoundSourceOptions& options,
                                     Result<std::unique_ptr<SoundSource>>& source);

using OpenSinkFunction = void(const std::string& output, const VideoFormat& format,
                              const SinkOptions& options, Result<std::unique_ptr<VideoSink>>& sink);

/// In kAvModule: encodes an image of RGB, scaled to this size, as a PNG file in memory.
inline constexpr const char* kEncodePngSymbol = "fbs_encode_png";
using EncodePngFunction = void(const RgbImage& image, int width, int height,
                               Result<std::vector<std::uint8_t>>& png);

/// In kImageModule: reads one image as a picture of a video.
inline constexpr const char* kReadImageSymbol = "fbs_read_image";
using ReadImageFunction = void(const std::string& name, const VideoFormat& format, Result<Picture>& picture);

}  // namespace fbs
