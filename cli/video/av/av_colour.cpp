#include "cli/video/av/av_colour.h"

extern "C" {
#include <libavutil/mastering_display_metadata.h>
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <array>
#include <cstdio>

#include "cli/video/av/av_picture.h"

namespace fbs {
namespace {

/// Luminance of white paper in HDR, which SDR shows as its white: ITU-R BT.2408.
constexpr int kReferenceWhite = 203;  // cd/m2

/// The peak luminance of HLG, and that of PQ where the file does not say.
constexpr double kUsualPeak = 1000;  // cd/m2

/// Up to this share of white, faces among it, HDR is shown as it is; what is brighter is compressed.
constexpr double kKnee = 0.7;

bool is_hdr(const AVFrame& frame) {
  return frame.color_trc == AVCOL_TRC_SMPTE2084 || frame.color_trc == AVCOL_TRC_ARIB_STD_B67;
}

bool is_bt2020_matrix(AVColorSpace matrix) {
  return matrix == AVCOL_SPC_BT2020_NCL || matrix == AVCOL_SPC_BT2020_CL || matrix == AVCOL_SPC_ICTCP;
}

/// Side data of the frame, or else of its stream.
template <class Data>
const Data* side_data(const AVStream& stream, AVPacketSideDataType in_stream, const AVFrame& frame,
                      AVFrameSideDataType in_frame) {
  if (const AVFrameSideData* found = av_frame_get_side_data(&frame, in_frame))
    return reinterpret_cast<const Data*>(found->data);
  return reinterpret_cast<const Data*>(av_stream_get_side_data(&stream, in_stream, nullptr));
}

/// cd/m2.
double peak_of(const AVStream& stream, const AVFrame& frame) {
  if (frame.color_trc == AVCOL_TRC_ARIB_STD_B67) return kUsualPeak;
  const auto* const light = side_data<AVContentLightMetadata>(stream, AV_PKT_DATA_CONTENT_LIGHT_LEVEL, frame,
                                                              AV_FRAME_DATA_CONTENT_LIGHT_LEVEL);
  if (light != nullptr && light->MaxCLL > 0) return light->MaxCLL;
  const auto* const display = side_data<AVMasteringDisplayMetadata>(
      stream, AV_PKT_DATA_MASTERING_DISPLAY_METADATA, frame, AV_FRAME_DATA_MASTERING_DISPLAY_METADATA);
  if (display != nullptr && display->has_luminance != 0 && display->max_luminance.num > 0)
    return av_q2d(display->max_luminance);
  return kUsualPeak;
}

std::string name_of(const AVFrame& frame) {
  if (frame.color_trc == AVCOL_TRC_SMPTE2084) return "HDR (PQ)";
  if (frame.color_trc == AVCOL_TRC_ARIB_STD_B67) return "HDR (HLG)";
  if (frame.color_primaries == AVCOL_PRI_SMPTE432) return "Display P3";
  if (frame.color_primaries == AVCOL_PRI_SMPTE431) return "DCI P3";
  return "BT.2020";
}

/// Colours in the numbers of ITU-T H.273, which libav and zscale share. A tag that is missing means what it
/// usually does.
struct Tags {
  int matrix, transfer, primaries;

  explicit Tags(const AVFrame& frame)
      : matrix(frame.colorspace), transfer(frame.color_trc), primaries(frame.color_primaries) {
    const bool wide = is_hdr(frame) || is_bt2020_matrix(frame.colorspace);
    if (primaries == AVCOL_PRI_UNSPECIFIED) primaries = wide ? AVCOL_PRI_BT2020 : AVCOL_PRI_BT709;
    if (matrix == AVCOL_SPC_UNSPECIFIED)
      matrix = primaries == AVCOL_PRI_BT2020 ? AVCOL_SPC_BT2020_NCL : AVCOL_SPC_BT709;
    const bool curve_of_709 = transfer == AVCOL_TRC_UNSPECIFIED || transfer == AVCOL_TRC_BT2020_10 ||
                              transfer == AVCOL_TRC_BT2020_12 || transfer == AVCOL_TRC_SMPTE170M;
    if (curve_of_709) transfer = AVCOL_TRC_BT709;
  }
};

/// Without HDR the transfer stays, as it does in sources of BT.709.
std::string graph_of(const AVStream& stream, const AVFrame& frame) {
  Tags tags(frame);
  const AVPixFmtDescriptor& format = *av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
  const bool is_rgb = (format.flags & AV_PIX_FMT_FLAG_RGB) != 0;
  const bool full = is_rgb || colour_range(frame) == ColourRange::kFull;
  const std::string alpha = (format.flags & AV_PIX_FMT_FLAG_ALPHA) != 0 ? "a" : "";
  if (is_rgb) tags.matrix = AVCOL_SPC_RGB;
  std::array<char, 192> in{}, map{}, out{};
  std::snprintf(in.data(), in.size(), "zscale=min=%d:tin=%d:pin=%d:rin=%s", tags.matrix, tags.transfer,
                tags.primaries, full ? "pc" : "tv");
  if (is_hdr(frame))
    std::snprintf(
        map.data(), map.size(),
        ":t=linear:npl=%d,format=gbr%spf32le,zscale=p=bt709,tonemap=mobius:param=%g:peak=%g,zscale=npl=%d",
        kReferenceWhite, alpha.c_str(), kKnee, std::max(peak_of(stream, frame) / kReferenceWhite, 1.0),
        kReferenceWhite);
  // zscale refuses odd sides of 4:2:0: swscale then halves the chroma.
  const bool odd = frame.width % 2 != 0 || frame.height % 2 != 0;
  const int transfer = is_hdr(frame) ? AVCOL_TRC_BT709 : tags.transfer;
  std::snprintf(out.data(), out.size(), ":m=bt709:t=%d:p=bt709:r=tv:d=error_diffusion,format=yuv%s%sp",
                transfer, alpha.c_str(), odd ? "444" : "420");
  const std::string even = is_rgb ? "format=gbr" + alpha + "p16le," : "format=yuv" + alpha + "444p16le,";
  return (odd ? even : "") + in.data() + map.data() + out.data();
}

}  // namespace

std::optional<ColourConversion> colour_conversion(const AVStream& stream, const AVFrame& frame) {
  const bool wide = frame.color_primaries == AVCOL_PRI_BT2020 ||
                    frame.color_primaries == AVCOL_PRI_SMPTE431 ||
                    frame.color_primaries == AVCOL_PRI_SMPTE432;
  if (!is_hdr(frame) && !wide && !is_bt2020_matrix(frame.colorspace)) return std::nullopt;
  return ColourConversion{graph_of(stream, frame), name_of(frame), is_hdr(frame)};
}

}  // namespace fbs
