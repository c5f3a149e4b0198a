// Videos and their sound by name: the name of a file, an image sequence, a pipe or a camera says who reads or
// writes it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "cli/video/sound_source.h"
#include "cli/video/video_sink.h"
#include "cli/video/video_source.h"

namespace fbs {

/// Whether `input` names a numbered sequence, several images or a folder of them.
bool is_image_sequence(const std::string& input);

/// The first bytes of Matroska files: the ID of their first element.
inline constexpr std::array<std::uint8_t, 4> kEbmlHead{0x1A, 0x45, 0xDF, 0xA3};

/// Whether this is a stream, or a Matroska file with one. False for pipes, which are not read.
bool is_stream_file(const std::string& name);

/// Opens `input`:
///   `-`                       Y4M on standard input
///   `name.y4m`                Y4M
///   `camera:N`                camera N through OpenCV
///   `frame_%05d.png`, `*.png` with `*` or `?`, or a folder
///                             image sequence through OpenImageIO, in order of number, then name
///   anything else             libav: every container, codec and address that ffmpeg opens
/// Rotated phone video is put upright; grey, 4:2:2, 4:4:4, more than 8 bits and RGB become 8-bit 4:2:0;
/// through libav HDR, BT.2020 and P3 become BT.709, and transparent parts black.
///
/// @return ErrorCode::kIo when it cannot be read, kUnsupported when it contains no video that we support,
///         kTooLarge when the pictures are outside the size limits
Result<std::unique_ptr<VideoSource>> open_video_source(const std::string& input,
                                                       const SourceOptions& options = {});

/// Whether the output may have sound: .mp4 and .mkv, in upper or lower case.
[[nodiscard]] bool has_sound_track(const std::string& output);

/// Opens `output`:
///   `null:`             discards the pictures
///   `-`, `name.y4m`     Y4M, on standard output or in a file
///   `name.mp4`, `.mkv`  H.264 (x264, CRF 12), for viewing: pictures are not exact.
///                       4:2:0, or 4:4:4 when a side is odd, since H.264 cannot crop half a chroma sample
///   `frame_%05d.png`    image sequence numbered from 1 through OpenImageIO, or another suffix that it writes
///
/// @return ErrorCode::kIo when it cannot be created (the text says why), kUnsupported for other names,
///         for sound with an output that has none, and for sound that is not Opus
Result<std::unique_ptr<VideoSink>> open_video_sink(const std::string& output, const VideoFormat& format,
                                                   const SinkOptions& options = {});

/// Opens the sound of `input`. Without pictures in it, times count from the start of the file.
/// @return null when there is none: in Y4M, image sequences, cameras and streams of our own, and in inputs
///         that cannot be read a second time beside the pictures (pipes, devices, addresses other than http);
///         ErrorCode::kIo when it cannot be read, kInvalidArgument for a missing track, kUnsupported when
///         there is no decoder for it
Result<std::unique_ptr<SoundSource>> open_sound_source(const std::string& input,
                                                       const SoundSourceOptions& options = {});

}  // namespace fbs
