// Samples of a texture: SPEC 10.8. Integers only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <utility>

#include "common/picture.h"
#include "decoder/raster/row_block.h"

namespace fbs {

/// Texture position along a run, 2^-16 sample of the texture; integers lie on the centres of samples.
struct TextureRow {
  LinearRow u, v;
};

/// Bilinear, to 1/256 sample, one sample after another. Positions outside the texture repeat its border.
void sample_row(const ConstPlaneView& texture, const TextureRow& at, std::uint8_t* out, int count);

/// Samples a texture for blocks of a triangle, as sample_row() does.
template <PlaneScale kScale>
class TextureSampler {
 public:
  /// @param textures  planes of one size
  /// @param corners   of the triangle in the planes, 1/64 luma pixel
  TextureSampler(const TriangleSetup& setup, const ScreenTriangle& t,
                 std::span<const ConstPlaneView> textures, const std::array<glm::ivec2, 3>& corners)
      : textures_(textures),
        straight_columns_(std::max(0, textures.front().width - kLaneCount)),
        is_in_place_(corners == std::array{t[0].at, t[1].at, t[2].at}) {
    u_ = setup.gradient({corners[0].x, corners[1].x, corners[2].x}, static_cast<int>(kScale));
    v_ = setup.gradient({corners[0].y, corners[1].y, corners[2].y}, static_cast<int>(kScale));
    // Texture coordinates of a sample's centre include half a sample, unlike its position in the plane.
    u_.origin -= kOne / 2;
    v_.origin -= kOne / 2;
    u_lanes_ = multiples(u_.dx);
    v_lanes_ = multiples(v_.dx);
  }

  [[nodiscard]] BlockSamples<kScale> sample(const RowBlock<kScale>& block) const {
    if (is_in_place_ && block.first + kLaneCount <= textures_.front().width &&
        block.row < textures_.front().height)
      return sample_in_place(block);
    const TextureRow at{block.along(u_), block.along(v_)};
    if (is_straight(at, block.count) && is_straight_inside(at)) return sample_straight(at, v_lanes_, true);
    return sample_other(at, block.count);
  }

 private:
  /// Not inline: keeps the common path small.
  [[nodiscard, gnu::noinline]] BlockSamples<kScale> sample_other(const TextureRow& at, int count) const {
    return is_inside(at) ? sample_bent(at) : sample_edge(at, count);
  }

  /// A block that needs samples at the border of the texture or beyond.
  [[nodiscard, gnu::noinline]] BlockSamples<kScale> sample_edge(const TextureRow& from, int count) const {
    const int width = textures_.front().width, height = textures_.front().height;
    const TextureRow at = {kept_inside(from.u, count, width), kept_inside(from.v, count, height)};
    const bool has_below = at.v.first < (height - 1) * kOne;
    const auto [low_u, high_u] = std::minmax({at.u.first, at.u.at(count - 1)});
    if (is_straight(at, count) && low_u >= 0 && high_u <= (width - 1) * kOne &&
        can_read(at.u.first >> 16, (at.v.first >> 16) + (has_below ? 1 : 0), kLaneCount + 1))
      return sample_straight(at, multiples(at.v.step), has_below);
    return sample_plain(at, count);
  }

  /// Positions all beyond one border of a texture are moved onto it.
  static LinearRow kept_inside(const LinearRow& row, int count, int size) {
    const std::int64_t last = (size - 1) * kOne, end = row.at(count - 1);
    if (row.first <= 0 && end <= 0) return {0, 0};
    if (row.first >= last && end >= last) return {last, 0};
    return row;
  }

  using Samples = BlockSamples<kScale>;
  static constexpr std::int64_t kOne = 1 << 16;

  static bool below(std::int64_t value, std::int64_t end) {
    return static_cast<std::uint64_t>(value) < static_cast<std::uint64_t>(end);
  }

  /// Whether the samples come from consecutive columns of the same two rows.
  [[nodiscard]] bool is_straight(const TextureRow& at, int count) const {
    // Whole parts of the positions: the first sample's plus 1 each in u, plus 0 in v.
    const auto keeps_step = [&](const LinearRow& row, std::int64_t step) {
      return below((row.first & (kOne - 1)) + (count - 1) * (row.step - step), kOne);
    };
    return keeps_step(at.u, kOne) && keeps_step(at.v, 0);
  }
  /// Whether kLaneCount + 1 samples can be read from the first column on, and the row below.
  [[nodiscard]] bool is_straight_inside(const TextureRow& at) const {
    return below(at.u.first >> 16, straight_columns_) &&
           below(at.v.first >> 16, textures_.front().height - 1);
  }
  /// Whether memory can be read from there on: the next row's samples follow the row's.
  [[nodiscard]] bool can_read(std::int64_t x, std::int64_t y, int samples) const {
    const std::int64_t width = textures_.front().width, height = textures_.front().height;
    return x >= 0 && below(y, height) && x + samples <= width * (height - y);
  }
  /// Whether kLaneCount samples lie inside the texture, with everything mixed into them.
  [[nodiscard]] bool is_inside(const TextureRow& at) const {
    const std::int64_t end_u = (textures_.front().width - 1) * kOne,
                       end_v = (textures_.front().height - 1) * kOne;
    return below(at.u.first, end_u) && below(at.v.first, end_v) && below(at.u.at(kLaneCount - 1), end_u) &&
           below(at.v.at(kLaneCount - 1), end_v);
  }

  [[nodiscard]] Lanes fraction(const LinearRow& row, Lanes steps) const {
    return (steps + static_cast<std::uint16_t>(row.first)) >> 8;
  }

  /// @param fx  share of the right samples, 1/256, 0..255
  /// @param fy  share of the lower samples, likewise
  static Lanes bilinear(Lanes top_left, Lanes top_right, Lanes bottom_left, Lanes bottom_right, Lanes fx,
                        Lanes fy) {
    const Lanes gx = 256 - fx;
    const Lanes top = top_left * gx + top_right * fx, bottom = bottom_left * gx + bottom_right * fx;
    // fy * (bottom - top) modulo 2^16: where top is larger, the difference has 2^16 too much.
    const Lanes share = fy << 8, too_much = bottom < top ? share : Lanes{};
    return (top + multiply_high(bottom - top, share) - too_much + 128) >> 8;
  }

  /// Triangles go down a texture a few samples at a time, which hardware prefetchers miss. Eight rows ahead
  /// is a third of the height of most triangles; man_glasses_720x1280 decodes in 3/4 of the time.
  static void prefetch_below(const std::uint8_t* samples, std::ptrdiff_t stride) {
    __builtin_prefetch(samples + 8 * stride);
  }

  [[nodiscard]] Samples sample_in_place(const RowBlock<kScale>& block) const {
    Samples out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const std::uint8_t* const from = textures_[i].row(block.row) + block.first;
      prefetch_below(from, textures_[i].stride);
      out[i] = load_lanes(from);
    }
    return out;
  }

  /// @param has_below  whether there is a row below; else the border repeats
  [[nodiscard]] Samples sample_straight(const TextureRow& at, Lanes v_lanes, bool has_below) const {
    const Lanes fx = fraction(at.u, u_lanes_), fy = fraction(at.v, v_lanes);
    Samples out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const std::uint8_t* const above =
          textures_[i].data + (at.v.first >> 16) * textures_[i].stride + (at.u.first >> 16);
      const std::uint8_t* const below_it = has_below ? above + textures_[i].stride : above;
      prefetch_below(above, textures_[i].stride);
      out[i] = bilinear(load_lanes(above), load_lanes(above + 1), load_lanes(below_it),
                        load_lanes(below_it + 1), fx, fy);
    }
    return out;
  }

  [[nodiscard]] Samples sample_bent(const TextureRow& at) const {
    const Lanes fx = fraction(at.u, u_lanes_), fy = fraction(at.v, v_lanes_);
    Samples out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const std::ptrdiff_t stride = textures_[i].stride;
      const auto pair = [&](int k) {
        return textures_[i].data + (at.v.at(k) >> 16) * stride + (at.u.at(k) >> 16);
      };
      const Lanes above = load_pairs(pair), under = load_pairs([&](int k) { return pair(k) + stride; });
      out[i] = bilinear(above & 255, above >> 8, under & 255, under >> 8, fx, fy);
    }
    return out;
  }

  [[nodiscard]] Samples sample_plain(const TextureRow& at, int count) const {
    Samples out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      std::array<std::uint8_t, kLaneCount> samples{};
      sample_row(textures_[i], at, samples.data(), count);
      out[i] = load_lanes(samples.data());
    }
    return out;
  }

  std::span<const ConstPlaneView> textures_;
  int straight_columns_;  ///< up to here kLaneCount + 1 samples can be read
  bool is_in_place_;      ///< the texture lies where it is drawn: samples match the plane's
  Gradient u_, v_;
  Lanes u_lanes_, v_lanes_;  ///< what each lane adds to the first position, modulo a sample
};

}  // namespace fbs
