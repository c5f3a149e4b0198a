#include "cli/video/av/av_picture.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <cstring>
#include <vector>

#include "cli/video/colour.h"

namespace fbs {
namespace {

constexpr int kScalerFlags =
    SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_BITEXACT;
constexpr int kOne = 1 << 16;  // contrast and saturation of 1

bool is_rgb(AVPixelFormat format) {
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(format);
  return description != nullptr && (description->flags & (AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL)) != 0;
}

bool is_grey(AVPixelFormat format) {
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(format);
  return description != nullptr && description->nb_components <= 2 && !is_rgb(format);
}

/// The J formats also imply full range; without them swscale leaves the range alone.
AVPixelFormat without_range(AVPixelFormat format) {
  switch (format) {
    case AV_PIX_FMT_YUVJ411P:
      return AV_PIX_FMT_YUV411P;
    case AV_PIX_FMT_YUVJ420P:
      return AV_PIX_FMT_YUV420P;
    case AV_PIX_FMT_YUVJ422P:
      return AV_PIX_FMT_YUV422P;
    case AV_PIX_FMT_YUVJ440P:
      return AV_PIX_FMT_YUV440P;
    case AV_PIX_FMT_YUVJ444P:
      return AV_PIX_FMT_YUV444P;
    default:
      return format;
  }
}

bool has_alpha(AVPixelFormat format) {
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(format);
  return description != nullptr && (description->flags & AV_PIX_FMT_FLAG_ALPHA) != 0;
}

/// RGB of more than 8 bits, which swscale would make up to .8 levels too bright: it takes 65536 for white.
bool is_deep_rgb(AVPixelFormat format) {
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(format);
  return is_rgb(format) && !has_alpha(format) && description->comp[0].depth > 8;
}

/// @param frame  AV_PIX_FMT_RGB48
Picture picture_of_rgb48(const AVFrame& frame) {
  const std::size_t row_bytes = 6 * static_cast<std::size_t>(frame.width);
  std::vector<std::uint16_t> rgb(3 * static_cast<std::size_t>(frame.width) *
                                 static_cast<std::size_t>(frame.height));
  for (int y = 0; y < frame.height; ++y) {
    std::memcpy(rgb.data() + static_cast<std::size_t>(y) * row_bytes / 2,
                frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0], row_bytes);
  }
  return picture_from_rgb(rgb, frame.width, frame.height, ColourRange::kLimited, ColourMatrix::kBt601);
}

/// Mixes samples with a level by their opacity, 0..255.
void mix(Plane& plane, int level, const Plane& alpha) {
  for (std::size_t i = 0; i < plane.samples.size(); ++i) {
    const int mixed = plane.samples[i] * alpha.samples[i] + level * (255 - alpha.samples[i]);
    plane.samples[i] = static_cast<std::uint8_t>((mixed + 127) / 255);
  }
}

/// Mean of the (up to) four samples that share a chroma sample.
Plane halved(const Plane& alpha) {
  Plane half((alpha.width + 1) / 2, (alpha.height + 1) / 2);
  for (int y = 0; y < half.height; ++y) {
    const std::uint8_t* upper = alpha.row(2 * y);
    const std::uint8_t* lower = alpha.row(std::min(2 * y + 1, alpha.height - 1));
    for (int x = 0; x < half.width; ++x) {
      const int right = std::min(2 * x + 1, alpha.width - 1);
      const int sum = upper[2 * x] + upper[right] + lower[2 * x] + lower[right];
      half.row(y)[x] = static_cast<std::uint8_t>((sum + 2) / 4);
    }
  }
  return half;
}

void copy_plane(const AVFrame& frame, int index, Plane& plane) {
  for (int y = 0; y < plane.height; ++y) {
    const std::uint8_t* row = frame.data[index] + static_cast<std::ptrdiff_t>(y) * frame.linesize[index];
    std::copy_n(row, plane.width, plane.row(y));
  }
}

}  // namespace

Result<Picture> FramePicture::convert(const AVFrame& frame) {
  const AVPixelFormat stored = without_range(static_cast<AVPixelFormat>(frame.format));
  const AVPixelFormat wanted = has_alpha(stored)     ? AV_PIX_FMT_YUVA420P
                               : is_grey(stored)     ? AV_PIX_FMT_GRAY8
                               : is_deep_rgb(stored) ? AV_PIX_FMT_RGB48
                                                     : AV_PIX_FMT_YUV420P;
  const AVFrame* planes = &frame;
  if (stored != wanted) {
    if (!scaled_) scaled_.reset(av_frame_alloc());
    av_frame_unref(scaled_.get());
    scaled_->width = frame.width;
    scaled_->height = frame.height;
    scaled_->format = wanted;
    scaler_.reset(sws_getCachedContext(scaler_.release(), frame.width, frame.height, stored, frame.width,
                                       frame.height, wanted, kScalerFlags, nullptr, nullptr, nullptr));
    if (!scaler_ || av_frame_get_buffer(scaled_.get(), 0) < 0) {
      const char* name = av_get_pix_fmt_name(stored);
      return fail(ErrorCode::kUnsupported,
                  std::string("pixel format ") + (name != nullptr ? name : "unknown"));
    }
    const int* bt601 = sws_getCoefficients(SWS_CS_ITU601);
    const int source_range = is_rgb(stored) ? 1 : 0;
    sws_setColorspaceDetails(scaler_.get(), bt601, source_range, bt601, 0, 0, kOne, kOne);
    const int rows = sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height, scaled_->data,
                               scaled_->linesize);
    if (rows != frame.height) return fail(ErrorCode::kUnsupported, "picture cannot be converted to 4:2:0");
    planes = scaled_.get();
  }
  if (wanted == AV_PIX_FMT_RGB48) return picture_of_rgb48(*planes);
  Picture picture(frame.width, frame.height);
  copy_plane(*planes, 0, picture.y);
  if (wanted != AV_PIX_FMT_GRAY8) {
    copy_plane(*planes, 1, picture.u);
    copy_plane(*planes, 2, picture.v);
  }
  if (wanted == AV_PIX_FMT_YUVA420P) {
    Plane alpha(frame.width, frame.height);
    copy_plane(*planes, 3, alpha);
    put_over_black(picture, alpha, colour_range(frame));
  }
  return picture;
}

void FramePicture::put_over_black(Picture& picture, const Plane& alpha, ColourRange range) {
  const bool opaque = std::ranges::all_of(alpha.samples, [](std::uint8_t a) { return a == 255; });
  if (opaque) return;
  was_transparent_ = true;
  const Plane half = halved(alpha);
  mix(picture.y, range == ColourRange::kFull ? 0 : 16, alpha);
  mix(picture.u, 128, half);
  mix(picture.v, 128, half);
}

ColourRange colour_range(const AVFrame& frame) {
  const auto format = static_cast<AVPixelFormat>(frame.format);
  if (is_rgb(format)) return ColourRange::kLimited;
  if (frame.color_range == AVCOL_RANGE_MPEG) return ColourRange::kLimited;
  const bool implied = without_range(format) != format || is_grey(format);
  return frame.color_range == AVCOL_RANGE_JPEG || implied ? ColourRange::kFull : ColourRange::kLimited;
}

ColourMatrix colour_matrix(const AVFrame& frame) {
  if (is_rgb(static_cast<AVPixelFormat>(frame.format))) return ColourMatrix::kBt601;
  switch (frame.colorspace) {
    case AVCOL_SPC_BT709:
      return ColourMatrix::kBt709;
    case AVCOL_SPC_BT470BG:
    case AVCOL_SPC_SMPTE170M:
    case AVCOL_SPC_FCC:
      return ColourMatrix::kBt601;
    default:
      return ColourMatrix::kUnspecified;
  }
}

}  // namespace fbs
