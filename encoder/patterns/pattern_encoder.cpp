#include "encoder/patterns/pattern_encoder.h"

#include <aom/aom_encoder.h>
#include <aom/aomcx.h>

#include <cstring>

namespace fbs {
namespace {

void copy_plane(const Plane& from, aom_image_t& image, int plane) {
  for (int y = 0; y < from.height; ++y)
    std::memcpy(image.planes[plane] + static_cast<std::ptrdiff_t>(y) * image.stride[plane], from.row(y),
                static_cast<std::size_t>(from.width));
}

aom_matrix_coefficients_t matrix_of(ColourMatrix m) {
  switch (m) {
    case ColourMatrix::kBt601:
      return AOM_CICP_MC_BT_601;
    case ColourMatrix::kBt709:
      return AOM_CICP_MC_BT_709;
    case ColourMatrix::kUnspecified:
      break;
  }
  return AOM_CICP_MC_UNSPECIFIED;
}

/// A temporal delimiter says nothing that our packets do not say already.
std::span<const std::uint8_t> without_delimiter(std::span<const std::uint8_t> unit) {
  const bool delimiter = unit.size() >= 2 && unit[0] == 0x12 && unit[1] == 0x00;
  return delimiter ? unit.subspan(2) : unit;
}

}  // namespace

struct PatternEncoder::Context {
  aom_codec_ctx_t codec{};
  bool open = false;
  aom_image_t image{};
  std::int64_t count = 0;
};

void PatternEncoder::Deleter::operator()(Context* c) const {
  if (c == nullptr) return;
  if (c->open) aom_codec_destroy(&c->codec);
  aom_img_free(&c->image);
  delete c;
}

Result<PatternEncoder> PatternEncoder::create(const VideoFormat& format, int quantiser) {
  if (quantiser < 0 || quantiser > 63) return fail(ErrorCode::kInvalidArgument, "quantiser outside 0..63");
  std::unique_ptr<Context, Deleter> context(new Context);
  aom_codec_iface_t* av1 = aom_codec_av1_cx();
  aom_codec_enc_cfg_t config;
  if (aom_codec_enc_config_default(av1, &config, AOM_USAGE_GOOD_QUALITY) != AOM_CODEC_OK)
    return fail(ErrorCode::kInternal, "libaom has no default configuration");
  config.g_w = static_cast<unsigned>(format.width);
  config.g_h = static_cast<unsigned>(format.height);
  config.g_threads = 1;
  config.g_lag_in_frames = 0;
  config.g_pass = AOM_RC_ONE_PASS;
  config.g_timebase = {1, 30};
  // A fixed quantiser: left to its own rate control libaom spends several kB on later patterns.
  config.rc_end_usage = AOM_Q;
  config.rc_min_quantizer = static_cast<unsigned>(quantiser);
  config.rc_max_quantizer = static_cast<unsigned>(quantiser);
  config.kf_mode = AOM_KF_DISABLED;
  if (aom_codec_enc_init(&context->codec, av1, &config, 0) != AOM_CODEC_OK)
    return fail(ErrorCode::kInternal, "libaom does not open");
  context->open = true;
  const auto set = [&](int key, int value) {
    return aom_codec_control(&context->codec, key, value) == AOM_CODEC_OK;
  };
  const bool configured = set(AOME_SET_CPUUSED, 3) && set(AOME_SET_CQ_LEVEL, quantiser) &&
                          set(AV1E_SET_ROW_MT, 0) && set(AV1E_SET_ENABLE_ORDER_HINT, 0) &&
                          set(AV1E_SET_COLOR_RANGE,
                              format.range == ColourRange::kFull ? AOM_CR_FULL_RANGE : AOM_CR_STUDIO_RANGE) &&
                          set(AV1E_SET_MATRIX_COEFFICIENTS, matrix_of(format.matrix));
  if (!configured) return fail(ErrorCode::kInternal, "libaom refuses a setting");
  if (aom_img_alloc(&context->image, AOM_IMG_FMT_I420, config.g_w, config.g_h, 32) == nullptr)
    return fail(ErrorCode::kInternal, "out of memory");
  return PatternEncoder(std::move(context));
}

Result<std::vector<std::uint8_t>> PatternEncoder::encode(const Picture& picture) {
  Context& c = *context_;
  if (picture.width() != static_cast<int>(c.image.d_w) || picture.height() != static_cast<int>(c.image.d_h))
    return fail(ErrorCode::kInvalidArgument, "a pattern of another size");
  copy_plane(picture.y, c.image, 0);
  copy_plane(picture.u, c.image, 1);
  copy_plane(picture.v, c.image, 2);
  if (aom_codec_encode(&c.codec, &c.image, c.count++, 1, 0) != AOM_CODEC_OK)
    return fail(ErrorCode::kInternal, "libaom cannot encode a pattern");
  std::vector<std::uint8_t> out;
  aom_codec_iter_t iterator = nullptr;
  while (const aom_codec_cx_pkt_t* packet = aom_codec_get_cx_data(&c.codec, &iterator)) {
    if (packet->kind != AOM_CODEC_CX_FRAME_PKT) continue;
    const auto unit =
        without_delimiter({static_cast<const std::uint8_t*>(packet->data.frame.buf), packet->data.frame.sz});
    out.insert(out.end(), unit.begin(), unit.end());
  }
  if (out.empty()) return fail(ErrorCode::kInternal, "libaom kept a pattern back");
  return out;
}

}  // namespace fbs
