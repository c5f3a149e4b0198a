#include "decoder/pattern_decoder.h"

#include <dav1d/dav1d.h>

#include <cerrno>
#include <cstring>

namespace fbs {
namespace {

void silent(void*, const char*, va_list) {}

void copy_plane(const Dav1dPicture& from, int plane, Plane& to) {
  const auto* source = static_cast<const std::uint8_t*>(from.data[plane]);
  const std::ptrdiff_t stride = from.stride[plane == 0 ? 0 : 1];
  for (int y = 0; y < to.height; ++y)
    std::memcpy(to.row(y), source + y * stride, static_cast<std::size_t>(to.width));
}

/// Unreferences a picture when the scope ends.
struct PictureGuard {
  Dav1dPicture picture{};
  PictureGuard() = default;
  PictureGuard(const PictureGuard&) = delete;
  PictureGuard& operator=(const PictureGuard&) = delete;
  ~PictureGuard() { dav1d_picture_unref(&picture); }
};

}  // namespace

struct PatternDecoder::Context {
  Dav1dContext* dav1d = nullptr;
  int width = 0, height = 0;
};

void PatternDecoder::Deleter::operator()(Context* c) const {
  if (c != nullptr && c->dav1d != nullptr) dav1d_close(&c->dav1d);
  delete c;
}

Result<PatternDecoder> PatternDecoder::create(int width, int height) {
  std::unique_ptr<Context, Deleter> context(new Context{nullptr, width, height});
  Dav1dSettings settings;
  dav1d_default_settings(&settings);
  settings.n_threads = 1;
  settings.max_frame_delay = 1;
  settings.apply_grain = 0;
  settings.frame_size_limit = static_cast<unsigned>(width) * static_cast<unsigned>(height);
  settings.logger.callback = silent;
  if (dav1d_open(&context->dav1d, &settings) < 0) return fail(ErrorCode::kInternal, "dav1d does not open");
  return PatternDecoder(std::move(context));
}

Result<Picture> PatternDecoder::decode(std::span<const std::uint8_t> av1) {
  if (av1.empty()) return fail(ErrorCode::kInvalidStream, "a pattern without data");
  Dav1dData data{};
  std::uint8_t* bytes = dav1d_data_create(&data, av1.size());
  if (bytes == nullptr) return fail(ErrorCode::kInternal, "out of memory");
  std::memcpy(bytes, av1.data(), av1.size());

  PictureGuard guard;
  bool got = false;
  const auto damaged = [&] {
    dav1d_data_unref(&data);
    return fail(ErrorCode::kInvalidStream, "a pattern's AV1 data is damaged");
  };
  while (data.sz > 0) {
    const int sent = dav1d_send_data(context_->dav1d, &data);
    if (sent < 0 && sent != DAV1D_ERR(EAGAIN)) return damaged();
    Dav1dPicture next{};
    const int taken = dav1d_get_picture(context_->dav1d, &next);
    if (taken == 0) {
      dav1d_picture_unref(&guard.picture);
      guard.picture = next;
      got = true;
    } else if (taken != DAV1D_ERR(EAGAIN) || sent != 0) {
      return damaged();
    }
  }
  if (!got && dav1d_get_picture(context_->dav1d, &guard.picture) < 0) return damaged();

  const Dav1dPicture& p = guard.picture;
  if (p.p.w != context_->width || p.p.h != context_->height || p.p.bpc != 8 ||
      p.p.layout != DAV1D_PIXEL_LAYOUT_I420)
    return fail(ErrorCode::kInvalidStream, "a pattern is not an 8-bit 4:2:0 picture of the stream's size");
  Picture out(p.p.w, p.p.h);
  copy_plane(p, 0, out.y);
  copy_plane(p, 1, out.u);
  copy_plane(p, 2, out.v);
  return out;
}

}  // namespace fbs
