#include "decoder/pattern/pattern_decoder.h"

#include <dav1d/dav1d.h>

#include <cerrno>
#include <cstring>

#include "decoder/pattern/obu.h"
#include "decoder/pattern/upscale.h"
#include "decoder/vectors/scalar.h"

// In no header of dav1d that is installed, but exported for its program; missing where a build hides it.
extern "C" [[gnu::weak]] void dav1d_set_cpu_flags_mask(unsigned mask);

namespace fbs {
namespace {

void silent(void*, const char*, va_list) {}

tl::unexpected<Error> damaged() {
  return fail(ErrorCode::kInvalidStream, "a pattern's AV1 data is damaged");
}

void copy_plane(const Dav1dPicture& from, int plane, Plane& to) {
  const auto* source = static_cast<const std::uint8_t*>(from.data[plane]);
  const std::ptrdiff_t stride = from.stride[plane == 0 ? 0 : 1];
  for (int y = 0; y < to.height; ++y)
    std::memcpy(to.row(y), source + y * stride, static_cast<std::size_t>(to.width));
}

Picture picture_of(const Dav1dPicture& from) {
  Picture out(from.p.w, from.p.h);
  copy_plane(from, 0, out.y);
  copy_plane(from, 1, out.u);
  copy_plane(from, 2, out.v);
  return out;
}

/// Rejects anything but one frame: it would leave pictures inside dav1d, or none to take out.
Result<void> check_one_frame(std::span<const std::uint8_t> av1) {
  bool sequence = false, frame = false;
  for (ObuReader reader(av1); !reader.done();) {
    const auto obu = reader.next();
    if (!obu) return fail(obu.error());
    const bool header = obu->type == ObuType::kSequenceHeader && !sequence && !frame;
    if (obu->has_extension || !(header || (obu->type == ObuType::kFrame && !frame)))
      return fail(ErrorCode::kInvalidStream, "a pattern has an AV1 unit out of place");
    (header ? sequence : frame) = true;
  }
  if (!frame) return fail(ErrorCode::kInvalidStream, "a pattern without a coded frame");
  return {};
}

/// Unreferences a picture when the scope ends.
struct PictureGuard {
  Dav1dPicture picture{};
  PictureGuard() = default;
  PictureGuard(const PictureGuard&) = delete;
  PictureGuard& operator=(const PictureGuard&) = delete;
  ~PictureGuard() { dav1d_picture_unref(&picture); }
};

/// Unreferences data that dav1d has not taken.
struct DataGuard {
  Dav1dData data{};
  DataGuard() = default;
  DataGuard(const DataGuard&) = delete;
  DataGuard& operator=(const DataGuard&) = delete;
  ~DataGuard() { dav1d_data_unref(&data); }
};

/// Feeds dav1d all of `av1` and takes out every picture.
/// @param picture  the last picture
/// @return the number of pictures
Result<int> feed(Dav1dContext* dav1d, std::span<const std::uint8_t> av1, Dav1dPicture& picture) {
  DataGuard input;
  std::uint8_t* bytes = dav1d_data_create(&input.data, av1.size());
  if (bytes == nullptr) return fail(ErrorCode::kInternal, "out of memory");
  std::memcpy(bytes, av1.data(), av1.size());
  int pictures = 0;
  for (bool more = true; more || input.data.sz > 0;) {
    const int sent = input.data.sz > 0 ? dav1d_send_data(dav1d, &input.data) : 0;
    if (sent < 0 && sent != DAV1D_ERR(EAGAIN)) return damaged();
    Dav1dPicture next{};
    const int taken = dav1d_get_picture(dav1d, &next);
    more = taken == 0;
    if (!more && (taken != DAV1D_ERR(EAGAIN) || sent != 0)) return damaged();
    if (!more) continue;
    dav1d_picture_unref(&picture);
    picture = next;
    ++pictures;
  }
  return pictures;
}

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
  if (kScalarOnly && dav1d_set_cpu_flags_mask != nullptr) dav1d_set_cpu_flags_mask(0);
  Dav1dSettings settings;
  dav1d_default_settings(&settings);
  settings.n_threads = 1;
  settings.max_frame_delay = 1;
  settings.apply_grain = 0;
  settings.output_invisible_frames = 1;
  settings.frame_size_limit = static_cast<unsigned>(width) * static_cast<unsigned>(height);
  settings.logger.callback = silent;
  if (dav1d_open(&context->dav1d, &settings) < 0) return fail(ErrorCode::kInternal, "dav1d does not open");
  return PatternDecoder(std::move(context));
}

Result<DecodedFrame> PatternDecoder::decode_frame(std::span<const std::uint8_t> av1) {
  if (auto checked = check_one_frame(av1); !checked) return fail(checked.error());
  PictureGuard guard;
  const auto pictures = feed(context_->dav1d, av1, guard.picture);
  if (!pictures) return fail(pictures.error());
  if (*pictures != 1) return damaged();

  const Dav1dPicture& p = guard.picture;
  const int width = context_->width, height = context_->height;
  const bool full = p.p.w == width && p.p.h == height;
  const bool reduced = p.p.w == reduced_size(width) && p.p.h == reduced_size(height);
  if (!(full || reduced) || p.p.bpc != 8 || p.p.layout != DAV1D_PIXEL_LAYOUT_I420)
    return fail(ErrorCode::kInvalidStream,
                "a pattern is not an 8-bit 4:2:0 picture of the stream's size or half of it");
  DecodedFrame out;
  out.picture = full ? picture_of(p) : upscaled(picture_of(p), width, height);
  out.reduced = !full;
  out.referable = p.frame_hdr->refresh_frame_flags != 0;
  out.order_hint = p.frame_hdr->frame_offset;
  return out;
}

Result<Picture> PatternDecoder::decode(std::span<const std::uint8_t> av1) {
  auto frame = decode_frame(av1);
  if (!frame) return fail(frame.error());
  return std::move(frame->picture);
}

}  // namespace fbs
