#include "decoder/raster/texture_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "decoder/raster/row_runs.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

using std::int64_t;

using Row = std::vector<std::uint8_t>;

/// A number of [low, high].
int64_t between(std::mt19937& random, int64_t low, int64_t high) {
  return low + static_cast<int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

TEST(SampleRow, TakesSamplesAndTheirMeans) {
  const Plane texture = noise_plane(9, 5, 1);
  Row out(4);
  const auto at = [](int64_t u, int64_t v, int64_t du) {
    return TextureRow{{u << 16, du << 16}, {v << 16, 0}};
  };
  sample_row(texture, at(2, 3, 1), out.data(), 4);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(out[i], texture.row(3)[2 + i]);
  sample_row(texture, at(6, 1, -2), out.data(), 4);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(out[i], texture.row(1)[6 - 2 * i]);
  sample_row(texture, {{(1 << 16) + (1 << 15), 0}, {2 << 16, 0}}, out.data(), 1);
  EXPECT_EQ(out[0], (texture.row(2)[1] + texture.row(2)[2] + 1) / 2);
}

TEST(SampleRow, RepeatsTheBorder) {
  const Plane texture = noise_plane(9, 5, 2);
  Row out(3);
  const int64_t far = int64_t{1} << 40;
  for (const auto& [u, v] : {std::pair{-far, -far}, {-far, far}, {far, -far}, {far, far}}) {
    sample_row(texture, {{u, 77}, {v, -5}}, out.data(), 3);
    EXPECT_EQ(out, Row(3, texture.row(v < 0 ? 0 : 4)[u < 0 ? 0 : 8]));
  }
}

// SPEC 10.8, word for word.
TEST(SampleRow, IsTheFormatsFormula) {
  std::mt19937 random(3);
  const Plane t = noise_plane(13, 11, 4);
  for (int i = 0; i < 20000; ++i) {
    const int64_t u = between(random, -(3 << 16), 16 << 16), v = between(random, -(3 << 16), 14 << 16);
    std::uint8_t out = 0;
    sample_row(t, {{u, 0}, {v, 0}}, &out, 1);
    const int64_t cu = std::clamp<int64_t>(u, 0, 12 << 16), cv = std::clamp<int64_t>(v, 0, 10 << 16);
    const int64_t x = cu >> 16, x1 = std::min<int64_t>(x + 1, 12), p = (cu >> 8) % 256;
    const int64_t y = cv >> 16, y1 = std::min<int64_t>(y + 1, 10), q = (cv >> 8) % 256;
    const auto at = [&](int64_t row, int64_t column) { return int64_t{t.samples[row * 13 + column]}; };
    const int64_t top = at(y, x) * (256 - p) + at(y, x1) * p, bottom = at(y1, x) * (256 - p) + at(y1, x1) * p;
    ASSERT_EQ(out, (top * (256 - q) + bottom * q + (1 << 15)) >> 16) << u << ' ' << v;
  }
}

constexpr int kWidth = 40, kHeight = 30;  // samples of the planes that are drawn

/// Takes every block of a triangle from a texture, with TextureSampler and with sample_row().
template <PlaneScale kScale>
void compare_sampling(const ScreenTriangle& t, const std::array<glm::ivec2, 3>& corners,
                      const Plane& texture) {
  const TriangleSetup setup(t, kScale);
  if (!setup.faces_viewer()) return;
  const std::array<ConstPlaneView, 2> views = {texture, texture};
  const TextureSampler<kScale> sampler(setup, t, std::span(views).first(plane_count(kScale)), corners);
  constexpr int kBits = static_cast<int>(kScale);
  const Gradient u = setup.gradient({corners[0].x, corners[1].x, corners[2].x}, kBits),
                 v = setup.gradient({corners[0].y, corners[1].y, corners[2].y}, kBits);
  for (int row = std::max(0, setup.first_row()); row <= std::min(kHeight - 1, setup.last_row()); ++row) {
    const RowRun run = covered_run(setup, row, {0, 0, kWidth, kHeight});
    for (int first = run.first; first <= run.last; first += kLaneCount) {
      const RowBlock<kScale> block{row, first, std::min(kLaneCount, run.last - first + 1),
                                   setup.from_corner(first, row)};
      TextureRow at{block.along(u), block.along(v)};
      at.u.first -= 1 << 15;
      at.v.first -= 1 << 15;
      Row plain(kLaneCount), fast(kLaneCount);
      sample_row(texture, at, plain.data(), block.count);
      for (const Lanes& plane : sampler.sample(block)) {
        store_lanes(plane, fast.data());
        ASSERT_TRUE(std::equal(plain.begin(), plain.begin() + block.count, fast.begin()))
            << first << ',' << row << " of " << kBits;
      }
    }
  }
}

glm::ivec2 random_corner(std::mt19937& random, int reach) {
  return {static_cast<int>(between(random, -8 * 64, (kWidth + 8) * reach)),
          static_cast<int>(between(random, -8 * 64, (kHeight + 8) * reach))};
}

// Textures that lie where they are drawn, a little beside, warped a little, anywhere, and of another size.
TEST(TextureSampler, AgreesWithSampleRow) {
  std::mt19937 random(5);
  for (int i = 0; i < 6000; ++i) {
    const bool luma = i % 2 == 0;
    const int reach = luma ? 64 : 128;
    ScreenTriangle t;
    std::array<glm::ivec2, 3> corners;
    const glm::ivec2 by(static_cast<int>(between(random, -300, 300)),
                        static_cast<int>(between(random, -300, 300)));
    for (std::size_t k = 0; k < 3; ++k) {
      t[k].at = random_corner(random, reach);
      const glm::ivec2 little(static_cast<int>(between(random, -40, 40)),
                              static_cast<int>(between(random, -40, 40)));
      switch (i / 2 % 4) {
        case 0:
          corners[k] = t[k].at;
          break;
        case 1:
          corners[k] = t[k].at + by;
          break;
        case 2:
          corners[k] = t[k].at + little;
          break;
        default:
          corners[k] = random_corner(random, reach);
      }
    }
    const bool tiny = i % 7 == 0;
    const Plane texture = noise_plane(tiny ? 1 + i % 10 : kWidth + (i % 3 - 1) * 9,
                                      tiny ? 1 + i % 4 : kHeight - i % 5 * 3, static_cast<unsigned>(i));
    if (luma)
      compare_sampling<PlaneScale::kLuma>(t, corners, texture);
    else
      compare_sampling<PlaneScale::kChroma>(t, corners, texture);
    if (HasFatalFailure()) FAIL() << i;
  }
}

}  // namespace
}  // namespace fbs
