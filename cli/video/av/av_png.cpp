#include "cli/video/av/av_png.h"

extern "C" {
#include <libavutil/opt.h>
}

#include <array>

#include "cli/video/av/av_support.h"

namespace fbs {
namespace {

constexpr int kCompression = 9;  // zlib's level: textures of exported heads are kept

tl::unexpected<Error> png_error(int code) {
  return fail(ErrorCode::kInternal, "libav cannot encode a PNG: " + av_reason(code));
}

/// @return null when there is no memory
AvFrame scaled(const RgbImage& image, int width, int height) {
  AvFrame frame(av_frame_alloc());
  if (!frame) return nullptr;
  frame->width = width;
  frame->height = height;
  frame->format = AV_PIX_FMT_RGB24;
  const AvScaler scaler(sws_getContext(image.width, image.height, AV_PIX_FMT_RGB24, width, height,
                                       AV_PIX_FMT_RGB24, SWS_AREA | SWS_ACCURATE_RND, nullptr, nullptr,
                                       nullptr));
  if (!scaler || av_frame_get_buffer(frame.get(), 0) < 0) return nullptr;
  const std::array<const std::uint8_t*, 1> rows{image.samples.data()};
  const std::array<int, 1> stride{3 * image.width};
  sws_scale(scaler.get(), rows.data(), stride.data(), 0, image.height, frame->data, frame->linesize);
  return frame;
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_png(const RgbImage& image, int width, int height) {
  const AVCodec* const codec = avcodec_find_encoder(AV_CODEC_ID_PNG);
  if (codec == nullptr) return fail(ErrorCode::kUnsupported, "libav has no encoder of PNG");
  const AvFrame frame = scaled(image, width, height);
  const AvCodec encoder(avcodec_alloc_context3(codec));
  const AvPacket packet(av_packet_alloc());
  if (!frame || !encoder || !packet) return png_error(AVERROR(ENOMEM));
  encoder->width = width;
  encoder->height = height;
  encoder->pix_fmt = AV_PIX_FMT_RGB24;
  encoder->time_base = kTick;
  encoder->compression_level = kCompression;
  av_opt_set(encoder->priv_data, "pred", "mixed", 0);
  int code = avcodec_open2(encoder.get(), codec, nullptr);
  if (code >= 0) code = avcodec_send_frame(encoder.get(), frame.get());
  if (code >= 0) code = avcodec_receive_packet(encoder.get(), packet.get());
  if (code < 0) return png_error(code);
  return std::vector<std::uint8_t>(packet->data, packet->data + packet->size);
}

}  // namespace fbs
