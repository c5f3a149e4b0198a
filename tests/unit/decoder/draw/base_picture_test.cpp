#include "decoder/draw/base_picture.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "decoder/raster/blend_weights.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

/// Draws patterns by the weights of the ground, in 1/256.
Picture drawn(const std::vector<Picture>& patterns, const std::vector<std::int32_t>& weights) {
  Picture out(patterns[0].width(), patterns[0].height());
  MeshBlend blend;
  std::vector<DrawnSource> sources;
  for (std::size_t k = 0; k < patterns.size(); ++k) {
    blend.sources.push_back({static_cast<std::uint8_t>(k), false});
    blend.ground.push_back(weights[k] * kShareOne);
    sources.push_back({{patterns[k].y, patterns[k].u, patterns[k].v}});
  }
  const ScreenMesh mesh;
  draw_base({mesh,
             blend,
             std::move(sources),
             {},
             {out.y, out.u, out.v},
             {0, 0, out.y.width, out.y.height},
             {0, 0, out.u.width, out.u.height}});
  return out;
}

TEST(BasePicture, OnePatternIsShownAsItIs) {
  const std::vector<Picture> patterns = {noise_picture(97, 65, 1), noise_picture(97, 65, 2)};
  EXPECT_EQ(drawn(patterns, {0, kBlendOne}), patterns[1]);
}

TEST(BasePicture, IsTheRoundedMeanByTheGroundsWeights) {
  std::mt19937 random(3);
  for (const auto& [width, height] : {std::pair{64, 64}, {97, 65}, {71, 64}, {160, 128}}) {
    std::vector<Picture> patterns;
    for (unsigned k = 0; k < kMaxRegionSources; ++k)
      patterns.push_back(noise_picture(width, height, 10 * k + 5));
    for (std::size_t used = 2; used <= kMaxRegionSources; ++used) {
      std::vector<std::int32_t> weights(patterns.size());
      std::int32_t left = kBlendOne;
      for (std::size_t k = 0; k + 1 < used; ++k) {
        weights[k] = 1 + static_cast<std::int32_t>(random() % static_cast<unsigned>(left / 2));
        left -= weights[k];
      }
      weights[used - 1] = left;
      const Picture out = drawn(patterns, weights);
      const auto expect = [&](Plane Picture::*plane) {
        for (std::size_t i = 0; i < (out.*plane).samples.size(); ++i) {
          int sum = kBlendOne / 2;
          for (std::size_t k = 0; k < used; ++k) sum += weights[k] * (patterns[k].*plane).samples[i];
          ASSERT_EQ((out.*plane).samples[i], sum >> kBlendOneLog2) << width << ' ' << i;
        }
      };
      expect(&Picture::y);
      expect(&Picture::u);
      expect(&Picture::v);
    }
  }
}

}  // namespace
}  // namespace fbs
