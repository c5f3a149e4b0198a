#include "encoder/patterns/av1_encoder.h"

#include <aom/aom_encoder.h>
#include <aom/aomcx.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

#include "encoder/patterns/coded_frames.h"

namespace fbs {
namespace {

constexpr int kMaxSpeed = 6;  // libaom's

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

void configure(const VideoFormat& format, const Av1Settings& settings, aom_codec_enc_cfg_t& config) {
  config.g_w = static_cast<unsigned>(format.width);
  config.g_h = static_cast<unsigned>(format.height);
  config.g_threads = settings.look_ahead > 0 ? static_cast<unsigned>(settings.threads) : 1;
  config.g_pass = AOM_RC_ONE_PASS;
  config.g_timebase = {1, 30};
  config.kf_mode = AOM_KF_DISABLED;
  config.g_lag_in_frames = static_cast<unsigned>(settings.look_ahead);
  config.rc_end_usage = AOM_Q;
  const int finest =
      settings.look_ahead > 0 ? std::max(0, settings.quantiser - settings.boost) : settings.quantiser;
  config.rc_min_quantizer = static_cast<unsigned>(finest);
  // libaom's own rate control spends several kB on later patterns.
  if (settings.look_ahead == 0) config.rc_max_quantizer = static_cast<unsigned>(settings.quantiser);
}

Result<void> check(int quantiser, int speed) {
  if (quantiser < 0 || quantiser > kMaxQuantiser)
    return fail(ErrorCode::kInvalidArgument, "quantiser outside 0..63");
  if (speed < 0 || speed > kMaxSpeed) return fail(ErrorCode::kInvalidArgument, "AV1 speed outside 0..6");
  return {};
}

bool set_controls(const VideoFormat& format, const Av1Settings& settings, aom_codec_ctx_t& codec) {
  const auto set = [&](int key, int value) { return aom_codec_control(&codec, key, value) == AOM_CODEC_OK; };
  const bool ahead = settings.look_ahead > 0;
  // Loop restoration gains 0.01 to 0.02 dB and sharpens what the quantiser left wrong: without it there are
  // 3, 4 and 7 % fewer false edges at quality 20, 50 and 80 (ten clips).
  // A plain background looks like screen content to libaom, and a key frame that may copy from itself has no
  // deblocking: the edges of its blocks then show on the face.
  const bool common = set(AOME_SET_CPUUSED, settings.speed) && set(AOME_SET_CQ_LEVEL, settings.quantiser) &&
                      set(AV1E_SET_ROW_MT, ahead ? 1 : 0) && set(AV1E_SET_ENABLE_RESTORATION, 0) &&
                      set(AV1E_SET_ENABLE_ORDER_HINT, ahead ? 1 : 0) && set(AV1E_SET_ENABLE_INTRABC, 0) &&
                      set(AV1E_SET_ENABLE_PALETTE, 0) &&
                      set(AV1E_SET_COLOR_RANGE,
                          format.range == ColourRange::kFull ? AOM_CR_FULL_RANGE : AOM_CR_STUDIO_RANGE) &&
                      set(AV1E_SET_MATRIX_COEFFICIENTS, matrix_of(format.matrix));
  // Overlays would code a picture twice. A quantiser that varies within the frame favours the ground: without
  // it, faces cost 6 % less at equal PSNR, first pictures 9 %, and whole frames the same.
  return common && (!ahead || (set(AV1E_SET_ENABLE_OVERLAY, 0) && set(AV1E_SET_DELTAQ_MODE, 0)));
}

}  // namespace

struct Av1Encoder::Context {
  aom_codec_ctx_t codec{};
  bool open = false;
  aom_image_t image{};
  std::int64_t count = 0;
  aom_codec_enc_cfg_t config{};

  /// Appends the frames that are ready. @return whether libaom wrote anything, if only to show a frame again
  Result<bool> take(Frames& out);
};

void Av1Encoder::Deleter::operator()(Context* c) const {
  if (c == nullptr) return;
  if (c->open) aom_codec_destroy(&c->codec);
  aom_img_free(&c->image);
  delete c;
}

Result<Av1Encoder> Av1Encoder::create(const VideoFormat& format, const Av1Settings& settings) {
  if (auto checked = check(settings.quantiser, settings.speed); !checked) return fail(checked.error());
  if (settings.boost < 0 || settings.boost > kMaxQuantiser)
    return fail(ErrorCode::kInvalidArgument, "boost outside 0..63");
  std::unique_ptr<Context, Deleter> context(new Context);
  aom_codec_iface_t* av1 = aom_codec_av1_cx();
  aom_codec_enc_cfg_t config;
  if (aom_codec_enc_config_default(av1, &config, AOM_USAGE_GOOD_QUALITY) != AOM_CODEC_OK)
    return fail(ErrorCode::kInternal, "libaom has no default configuration");
  configure(format, settings, config);
  if (aom_codec_enc_init(&context->codec, av1, &config, 0) != AOM_CODEC_OK)
    return fail(ErrorCode::kInternal, "libaom does not open");
  context->open = true;
  context->config = config;
  if (!set_controls(format, settings, context->codec))
    return fail(ErrorCode::kInternal, "libaom refuses a setting");
  if (aom_img_alloc(&context->image, AOM_IMG_FMT_I420, config.g_w, config.g_h, 32) == nullptr)
    return fail(ErrorCode::kInternal, "out of memory");
  return Av1Encoder(std::move(context));
}

Result<bool> Av1Encoder::Context::take(Frames& out) {
  bool any = false;
  aom_codec_iter_t iterator = nullptr;
  while (const aom_codec_cx_pkt_t* packet = aom_codec_get_cx_data(&codec, &iterator)) {
    if (packet->kind != AOM_CODEC_CX_FRAME_PKT) continue;
    any = true;
    auto frames =
        coded_frames({static_cast<const std::uint8_t*>(packet->data.frame.buf), packet->data.frame.sz});
    if (!frames) return fail(frames.error());
    std::move(frames->begin(), frames->end(), std::back_inserter(out));
  }
  return any;
}

Result<Av1Encoder::Frames> Av1Encoder::encode(const Picture& picture, bool alone) {
  Context& c = *context_;
  if (picture.width() != static_cast<int>(c.image.d_w) || picture.height() != static_cast<int>(c.image.d_h))
    return fail(ErrorCode::kInvalidArgument, "a pattern of another size");
  copy_plane(picture.y, c.image, 0);
  copy_plane(picture.u, c.image, 1);
  copy_plane(picture.v, c.image, 2);
  constexpr aom_enc_frame_flags_t kNoUpdate =
      AOM_EFLAG_NO_UPD_LAST | AOM_EFLAG_NO_UPD_GF | AOM_EFLAG_NO_UPD_ARF | AOM_EFLAG_NO_UPD_ENTROPY;
  const aom_enc_frame_flags_t flags = alone && c.count > 0 ? kNoUpdate : 0;
  if (aom_codec_encode(&c.codec, &c.image, c.count++, 1, flags) != AOM_CODEC_OK)
    return fail(ErrorCode::kInternal, "libaom cannot encode a pattern");
  Frames out;
  if (auto taken = c.take(out); !taken) return fail(taken.error());
  return out;
}

Result<void> Av1Encoder::set(int quantiser, int speed) {
  if (auto checked = check(quantiser, speed); !checked) return checked;
  Context& c = *context_;
  c.config.rc_min_quantizer = c.config.rc_max_quantizer = static_cast<unsigned>(quantiser);
  if (aom_codec_enc_config_set(&c.codec, &c.config) != AOM_CODEC_OK ||
      aom_codec_control(&c.codec, AOME_SET_CQ_LEVEL, quantiser) != AOM_CODEC_OK ||
      aom_codec_control(&c.codec, AOME_SET_CPUUSED, speed) != AOM_CODEC_OK)
    return fail(ErrorCode::kInternal, "libaom refuses a quantiser or a speed");
  return {};
}

Result<Av1Encoder::Frames> Av1Encoder::finish() {
  Frames out;
  for (;;) {
    if (aom_codec_encode(&context_->codec, nullptr, 0, 0, 0) != AOM_CODEC_OK)
      return fail(ErrorCode::kInternal, "libaom cannot encode a pattern");
    const auto taken = context_->take(out);
    if (!taken) return fail(taken.error());
    if (!*taken) return out;
  }
}

}  // namespace fbs
