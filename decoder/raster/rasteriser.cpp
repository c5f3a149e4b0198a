#include "decoder/raster/rasteriser.h"

#include <algorithm>
#include <limits>

#include "common/state.h"

namespace fbs {
namespace {

using std::int32_t;
using std::int64_t;

/// Gradients per sample are clamped to this; only slivers reach it.
constexpr int64_t kMaxGradient = int64_t{1} << 30;

/// What light adds is clamped to this, 1/16 grey level in Q16.
constexpr int64_t kMostLit = int64_t{kMaxLight} << 16;

int64_t twice_area(const RasterTriangle& t) {
  const int64_t ax = t[1].screen.x - t[0].screen.x, ay = t[1].screen.y - t[0].screen.y;
  const int64_t bx = t[2].screen.x - t[0].screen.x, by = t[2].screen.y - t[0].screen.y;
  return ax * by - ay * bx;
}

int64_t floor_div(int64_t a, int64_t b) {  // b > 0
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

/// A quantity that is linear over the triangle, Q16 per sample of the plane.
struct Gradient {
  int64_t origin;  ///< value at corner 0
  int64_t dx, dy;  ///< per sample
  bool exact = true;

  /// @param value  at the corners, in units of which `1 << bits` make 1
  Gradient(const RasterTriangle& t, const std::array<int64_t, 3>& value, int bits, int64_t area,
           int position_bits) {
    const int64_t ax = t[1].screen.x - t[0].screen.x, ay = t[1].screen.y - t[0].screen.y;
    const int64_t bx = t[2].screen.x - t[0].screen.x, by = t[2].screen.y - t[0].screen.y;
    const int64_t va = value[1] - value[0], vb = value[2] - value[0];
    // value / 2^bits per position, times 2^position_bits positions per sample, in Q16
    const int shift = 16 - bits + position_bits;
    dx = limited(((va * by - vb * ay) << shift) / area);
    dy = limited(((vb * ax - va * bx) << shift) / area);
    origin = value[0] << (16 - bits);
  }

  [[nodiscard]] int64_t at(int64_t position_dx, int64_t position_dy, int position_bits) const {
    return origin + ((dx * position_dx + dy * position_dy) >> position_bits);
  }

 private:
  int64_t limited(int64_t g) {
    const int64_t c = std::clamp(g, -kMaxGradient, kMaxGradient);
    exact = exact && c == g;
    return c;
  }
};

/// One edge as a half plane: inside where a x + b y + c > 0, or == 0 on a top or left edge.
struct Edge {
  int64_t a, b, c;

  Edge(glm::ivec2 from, glm::ivec2 to) {
    a = int64_t{from.y} - to.y;
    b = int64_t{to.x} - from.x;
    c = -(a * from.x + b * from.y);
    const bool left = a > 0;           // the edge goes up: the inside is to its right
    const bool top = a == 0 && b > 0;  // the edge goes right: the inside is below
    if (!left && !top) c -= 1;
  }

  /// Narrows [first, last] to the samples of row position y that are inside.
  void clip(int64_t y, int position_bits, int64_t& first, int64_t& last) const {
    // sample x is at position (x << bits) + half; inside: a x' + d >= 0
    const int64_t half = int64_t{1} << (position_bits - 1);
    const int64_t d = b * y + c + a * half;
    const int64_t step = a << position_bits;
    if (step > 0) {
      first = std::max(first, -floor_div(d, step));
    } else if (step < 0) {
      last = std::min(last, floor_div(d, -step));
    } else if (d < 0) {
      last = first - 1;
    }
  }
};

std::uint8_t blend(int32_t a, int32_t b, int32_t c, int32_t d, int32_t fx, int32_t fy) {
  const int32_t top = a * (256 - fx) + b * fx;
  const int32_t bottom = c * (256 - fx) + d * fx;
  return static_cast<std::uint8_t>((top * (256 - fy) + bottom * fy + (1 << 15)) >> 16);
}

/// Bilinear; u and v in Q16 samples, already moved by half a sample. Positions outside repeat the border.
std::uint8_t sample_clamped(const Plane& p, int64_t u, int64_t v) {
  const int64_t max_u = int64_t{p.width - 1} << 16, max_v = int64_t{p.height - 1} << 16;
  u = std::clamp<int64_t>(u, 0, max_u);
  v = std::clamp<int64_t>(v, 0, max_v);
  const int x0 = static_cast<int>(u >> 16), y0 = static_cast<int>(v >> 16);
  const int x1 = std::min(x0 + 1, p.width - 1), y1 = std::min(y0 + 1, p.height - 1);
  const std::uint8_t* top = p.row(y0);
  const std::uint8_t* bottom = p.row(y1);
  return blend(top[x0], top[x1], bottom[x0], bottom[x1], static_cast<int32_t>((u >> 8) & 255),
               static_cast<int32_t>((v >> 8) & 255));
}

/// The same where all four neighbours are known to be inside.
std::uint8_t sample_inside(const std::uint8_t* samples, int stride, int32_t u, int32_t v) {
  const std::uint8_t* s = samples + static_cast<std::ptrdiff_t>(v >> 16) * stride + (u >> 16);
  return blend(s[0], s[1], s[stride], s[stride + 1], (u >> 8) & 255, (v >> 8) & 255);
}

/// Whether every sample the triangle can ask for lies a whole sample inside the pattern.
bool reads_inside(const RasterTriangle& t, const Plane& pattern, int position_bits) {
  const int margin = 2 << position_bits;
  const int max_x = (pattern.width << position_bits) - margin,
            max_y = (pattern.height << position_bits) - margin;
  return std::all_of(t.begin(), t.end(), [&](const RasterVertex& v) {
    return v.texture.x >= margin && v.texture.x <= max_x && v.texture.y >= margin && v.texture.y <= max_y;
  });
}

/// A way through the pattern, one step per sample of a row; Q16 samples, moved by half a sample.
struct Walk {
  int64_t u, v, du, dv;
  bool inside;  ///< no step of it needs clamping

  [[nodiscard]] Walk from(int64_t steps) const { return {u + steps * du, v + steps * dv, du, dv, inside}; }

  /// Samples [first, last] of a row.
  void fill(const Plane& pattern, std::uint8_t* out, int64_t first, int64_t last) const {
    if (inside) {
      auto iu = static_cast<int32_t>(u), iv = static_cast<int32_t>(v);
      const auto step_u = static_cast<int32_t>(du), step_v = static_cast<int32_t>(dv);
      const std::uint8_t* samples = pattern.samples.data();
      const int stride = pattern.width;
      for (int64_t x = first; x <= last; ++x, iu += step_u, iv += step_v)
        out[x] = sample_inside(samples, stride, iu, iv);
    } else {
      int64_t su = u, sv = v;
      for (int64_t x = first; x <= last; ++x, su += du, sv += dv) out[x] = sample_clamped(pattern, su, sv);
    }
  }
};

/// Mixes a ramp of colours over samples [first, last] of a row.
/// @param ramp  0..256 in Q16 at `first`  @param step  per sample
void mix(const PlanePair& plane, int32_t amount, int64_t ramp, int64_t step, int row, int64_t first,
         int64_t last) {
  std::uint8_t* out = plane.target->row(row);
  for (int64_t x = first; x <= last; ++x, ramp += step) {
    const auto at = static_cast<int32_t>(std::clamp<int64_t>(ramp >> 16, 0, 256));
    const auto below = static_cast<std::size_t>(at < 128 ? 0 : 1);
    const int32_t way = at - 128 * static_cast<int32_t>(below);
    const int32_t colour = (plane.shade[below] * (128 - way) + plane.shade[below + 1] * way + 64) >> 7;
    out[x] = static_cast<std::uint8_t>((out[x] * (256 - amount) + colour * amount + 128) >> 8);
  }
}

/// Adds light to samples [first, last] of a row.
/// @param offset, gain  1/16 grey level in Q16 at `first`  @param offset_step, gain_step  per sample
void add_light(std::uint8_t* out, int64_t offset, int64_t offset_step, int64_t gain, int64_t gain_step,
               int64_t first, int64_t last) {
  // Slivers, whose gradients are clamped, go beyond what their corners have.
  const auto limited = [](int64_t v) {
    return static_cast<int32_t>(std::clamp(v, -kMostLit, kMostLit) >> 8);
  };
  for (int64_t x = first; x <= last; ++x, offset += offset_step, gain += gain_step) {
    // 2^-12 grey level
    const int32_t by_gain = (out[x] - 128) * limited(gain) >> 6;
    const int32_t sum = (out[x] << 12) + limited(offset) + by_gain;
    out[x] = static_cast<std::uint8_t>(std::clamp((sum + (1 << 11)) >> 12, 0, 255));
  }
}

/// Calls draw(from, to) for each run of samples of [first, last] that are nearer than what is there, and
/// notes them.
/// @param z  depth at `first`  @param dz  per sample
template <class Draw>
void for_each_nearer(int32_t* nearest, int64_t first, int64_t last, int64_t z, int64_t dz, Draw&& draw) {
  int64_t run = -1;
  for (int64_t x = first; x <= last; ++x, z += dz) {
    const auto here = static_cast<int32_t>(std::clamp<int64_t>(z, INT32_MIN, INT32_MAX - 1));
    if (here < nearest[x]) {
      nearest[x] = here;
      if (run < 0) run = x;
    } else if (run >= 0) {
      draw(run, x - 1);
      run = -1;
    }
  }
  if (run >= 0) draw(run, last);
}

}  // namespace

void DepthPlane::reset(int w, int height, const SampleArea& area) {
  width = w;
  depth.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(height));
  for (int y = area.y0; y < area.y1; ++y) {
    int32_t* row = depth.data() + static_cast<std::ptrdiff_t>(y) * w;
    std::fill(row + area.x0, row + area.x1, std::numeric_limits<int32_t>::max());
  }
}

bool faces_viewer(const RasterTriangle& triangle) {
  return twice_area(triangle) > 0;
}

void draw_triangle(const RasterTriangle& t, PlaneScale scale, std::span<const PlanePair> planes,
                   const SampleArea& area_to_draw, DepthPlane* depth, const Finish& finish) {
  const int64_t area = twice_area(t);
  if (area <= 0) return;
  const int bits = static_cast<int>(scale);
  const int64_t half = int64_t{1} << (bits - 1);
  const auto [low, high] = std::minmax({t[0].screen.y, t[1].screen.y, t[2].screen.y});
  const int first_row = static_cast<int>(std::max<int64_t>(area_to_draw.y0, (low - half) >> bits));
  const int last_row = static_cast<int>(std::min<int64_t>(area_to_draw.y1 - 1, (high - half) >> bits));
  if (first_row > last_row) return;

  const Plane& shape = *planes.front().pattern;
  const Gradient u(t, {t[0].texture.x, t[1].texture.x, t[2].texture.x}, bits, area, bits);
  const Gradient v(t, {t[0].texture.y, t[1].texture.y, t[2].texture.y}, bits, area, bits);
  const Gradient z(t, {t[0].depth, t[1].depth, t[2].depth}, 16, area, bits);
  const Shade* shade = finish.shade;
  const auto over = [&](const std::array<int32_t, 3>& c) {
    return Gradient(t, {c[0], c[1], c[2]}, 0, area, bits);
  };
  const Gradient ramp = over(shade != nullptr ? shade->ramp : std::array<int32_t, 3>{});
  const Light light = finish.light != nullptr ? *finish.light : Light{};
  const Gradient offset = over(light.offset), gain = over(light.gain);
  const bool fast = u.exact && v.exact && reads_inside(t, shape, bits);
  const std::array<Edge, 3> edges = {Edge(t[0].screen, t[1].screen), Edge(t[1].screen, t[2].screen),
                                     Edge(t[2].screen, t[0].screen)};

  for (int row = first_row; row <= last_row; ++row) {
    const int64_t y = (int64_t{row} << bits) + half;
    int64_t first = area_to_draw.x0, last = area_to_draw.x1 - 1;
    for (const Edge& e : edges) e.clip(y, bits, first, last);
    if (first > last) continue;

    const int64_t dx = (first << bits) + half - t[0].screen.x, dy = y - t[0].screen.y;
    const Walk walk{u.at(dx, dy, bits) - (1 << 15), v.at(dx, dy, bits) - (1 << 15), u.dx, v.dx, fast};
    if (depth == nullptr) {
      for (const PlanePair& p : planes) walk.fill(*p.pattern, p.target->row(row), first, last);
    } else {
      int32_t* nearest = depth->depth.data() + static_cast<std::ptrdiff_t>(row) * depth->width;
      for_each_nearer(nearest, first, last, z.at(dx, dy, bits), z.dx, [&](int64_t from, int64_t to) {
        const int64_t steps = from - first;
        for (const PlanePair& p : planes) {
          walk.from(steps).fill(*p.pattern, p.target->row(row), from, to);
          if (finish.light != nullptr && &p == &planes.front())
            add_light(p.target->row(row), offset.at(dx, dy, bits) + steps * offset.dx, offset.dx,
                      gain.at(dx, dy, bits) + steps * gain.dx, gain.dx, from, to);
          if (shade != nullptr)
            mix(p, shade->amount, ramp.at(dx, dy, bits) + steps * ramp.dx, ramp.dx, row, from, to);
        }
      });
    }
  }
}

}  // namespace fbs
