// YUV4MPEG2: the plain format of uncompressed video, for pipes and exact files. Needs no library.
//
// A line of text ("YUV4MPEG2 W352 H288 F30000:1001 Ip A128:117 C420mpeg2"), then for each picture a line
// "FRAME" and the planes. Read: 4:2:0 in all its variants, mono, 4:1:1, 4:2:2, 4:4:4 (alpha dropped), 8 to
// 16 bits; what is not 8-bit 4:2:0 is converted by box averages, more than 8 bits dithered. Written:
// C420mpeg2 with XCOLORRANGE, and our own XMATRIX=BT601 or BT709 where the matrix is known and the line stays
// short; other programs ignore it.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "cli/video/video_sink.h"
#include "cli/video/video_source.h"

namespace fbs {

/// How the samples of a Y4M picture are stored.
struct Y4mLayout {
  bool has_chroma = true;
  bool has_alpha = false;
  int chroma_shift_x = 1;  ///< log2 of luma columns per chroma column
  int chroma_shift_y = 1;  ///< log2 of luma rows per chroma row
  int bits = 8;            ///< 8..16; above 8 a sample is two bytes, low byte first
};

struct Y4mHeader {
  VideoFormat format;
  Y4mLayout layout;
};

/// Parses the first line, without its newline.
/// @return ErrorCode::kInvalidStream, kUnsupported (unknown chroma format) or kTooLarge
Result<Y4mHeader> parse_y4m_header(std::string_view line);

/// The first line as we write it, without its newline; at most 95 bytes, ffmpeg's limit, for sane rates.
std::string y4m_header(const VideoFormat& format);

/// @param input  a file name, or `-` for standard input
Result<std::unique_ptr<VideoSource>> open_y4m_source(const std::string& input);

/// Whether open_video_sink writes Y4M to this output.
[[nodiscard]] inline bool is_y4m_output(const std::string& output) {
  return output == "-" || output.ends_with(".y4m");
}

/// @param output  a file name, or `-` for standard output
Result<std::unique_ptr<VideoSink>> open_y4m_sink(const std::string& output, const VideoFormat& format);

}  // namespace fbs
