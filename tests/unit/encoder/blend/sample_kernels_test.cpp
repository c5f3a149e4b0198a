#include "encoder/blend/sample_kernels.h"

#include <gtest/gtest.h>

#include <random>

namespace fbs {
namespace {

/// Quarters of grey levels.
ReducedPlane noise(int width, int height, unsigned seed) {
  ReducedPlane out{width, height, {}};
  std::mt19937 random(seed);
  for (int i = 0; i < width * height; ++i) out.samples.push_back(static_cast<float>(random() % 1020) / 4);
  return out;
}

/// a + share * (b - a) without a fused product.
float between(float a, float b, float share) {
  const volatile float product = share * (b - a);
  return a + product;
}

float at_first(const TriangleValue& v, const SurfaceRun& run) {
  const volatile float by_column = static_cast<float>(run.first) * v.per_column;
  const volatile float by_row = static_cast<float>(run.row) * v.per_row;
  return v.origin + by_column + by_row;
}

float along(const TriangleValue& v, const SurfaceRun& run, int i) {
  const volatile float more = static_cast<float>(i) * v.per_column;
  return at_first(v, run) + more;
}

/// One sample by plain arithmetic.
int plain_sample(const TriangleSource& source, const ReducedPlane& luma, const SurfaceRun& run, int i) {
  const TexturePlace place = source.place.value_or(TexturePlace{{0, 1, 0}, {0, 0, 1}});
  const auto inside = [&](float at, int size) {
    return std::clamp(at, source.inset, static_cast<float>(size - 1) - source.inset);
  };
  const float u = inside(along(place.u, run, i), luma.width), v = inside(along(place.v, run, i), luma.height);
  const int x = std::min(static_cast<int>(u), luma.width - 2),
            y = std::min(static_cast<int>(v), luma.height - 2);
  const float *a = luma.row(y) + x, *b = luma.row(y + 1) + x;
  const float fx = u - static_cast<float>(x), fy = v - static_cast<float>(y);
  float sample = between(between(a[0], a[1], fx), between(b[0], b[1], fx), fy);
  if (source.light) {
    const volatile float gained = at_first(source.light->gain, run) * (sample - 128.0F);
    sample = std::clamp(sample + gained + along(source.light->offset, run, i), 0.0F, 255.0F);
    sample = between(sample, source.light->interior[0], source.light->opacity);
  }
  return rounded(sample);
}

// Places that reach beyond each border, runs of all lengths, with and without light.
TEST(ShownSamples, DifferencesAreThoseOfPlainArithmetic) {
  const ReducedPlane luma = noise(40, 30, 1), shown = noise(44, 33, 2);
  std::vector<TriangleSource> sources(4);
  sources[1].place = TexturePlace{{-3, 0.93F, 0.21F}, {-2, -0.17F, 1.1F}};
  sources[1].inset = 0.75F;
  sources[2].place = TexturePlace{{1.3F, 1.02F, -0.1F}, {4.2F, 0.06F, 0.9F}};
  sources[2].light = TriangleLight{{3, 0.4F, -0.7F}, {-0.2F, 0.01F, 0.02F}, 0, {}};
  sources[3].place = sources[2].place;
  sources[3].light = TriangleLight{{-90, 4, 3}, {0.9F, 0, 0}, 0.4F, {31, 0, 0}};
  std::vector<SurfaceRun> runs;
  ShownSamples samples(30 * 31 / 2);
  for (int k = 0; k < 30; ++k) {
    runs.push_back({k, k % 7, 1 + k, 0});
    samples.add(runs.back(), shown);
  }
  for (std::size_t s = 0; s < sources.size(); ++s) {
    std::vector<std::int16_t> out(samples.size() + ShownSamples::kLanes);
    samples.differences(sources[s], luma, 0, samples.size(), out.data());
    const std::int16_t* next = out.data();
    for (const SurfaceRun& run : runs)
      for (int i = 0; i < run.count; ++i)
        EXPECT_EQ(*next++,
                  plain_sample(sources[s], luma, run, i) - rounded(shown.row(run.row)[run.first + i]))
            << s << ": " << run.row << ' ' << i;
  }
}

TEST(ShownSamples, DifferencesOfAPartAreThoseOfTheWhole) {
  const ReducedPlane luma = noise(40, 30, 3), shown = noise(40, 30, 4);
  ShownSamples samples(55);
  for (int k = 0; k < 5; ++k) samples.add({k, 2, 11, 0}, shown);
  std::vector<std::int16_t> whole(samples.size() + ShownSamples::kLanes), part(whole.size());
  samples.differences({}, luma, 0, samples.size(), whole.data());
  samples.differences({}, luma, 13, 37, part.data());
  EXPECT_TRUE(std::equal(part.begin(), part.begin() + 24, whole.begin() + 13));
}

TEST(ErrorProduct, IsThatOfWholeNumbers) {
  std::mt19937 random(5);
  for (const std::size_t count : {0U, 1U, 31U, 32U, 4096U, 9001U}) {
    std::vector<std::int16_t> a(count, 255), b(count, -255);
    EXPECT_EQ(error_product(a, b), -255 * 255 * static_cast<std::int64_t>(count)) << "the largest there are";
    std::int64_t expected = 0;
    for (std::size_t i = 0; i < count; ++i) {
      a[i] = static_cast<std::int16_t>(static_cast<int>(random() % 511) - 255);
      b[i] = static_cast<std::int16_t>(static_cast<int>(random() % 511) - 255);
      expected += a[i] * b[i];
    }
    EXPECT_EQ(error_product(a, b), expected) << count;
  }
}

}  // namespace
}  // namespace fbs
