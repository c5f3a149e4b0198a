// The vectorised sums against the plain ones.
#include "encoder/track/head/alignment_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fbs {
namespace {

struct Measured {
  glm::vec3 point;
  Sample sample;
  float seen, difference, weight;
};

std::vector<Measured> some(std::size_t count) {
  std::mt19937 random(3);
  const auto within = [&](float most) { return most * (static_cast<float>(random() % 2001) / 1000 - 1); };
  std::vector<Measured> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back({{within(4000), within(4000), within(2000)},
                   {0, within(20), within(20)},
                   100 + within(50),
                   within(40),
                   1 + within(0.9F)});
  return out;
}

Pose pose() {
  Pose p;
  p.yaw = 0.2;
  p.pitch = -0.1;
  p.shift = {100, 80};
  return p;
}

constexpr double kPerUnit = 0.7, kSigma = 15;

TEST(AlignmentSums, AreThoseOfOnePointAtATime) {
  const PoseJacobian jacobian(pose());
  for (const std::size_t count : {1U, 7U, 64U, 65U, 200U}) {
    AlignmentSums sums(jacobian, kPerUnit, kSigma);
    auto a = AlignmentSums::Matrix::zeros(), plain_a = a;
    AlignmentSums::Vector b, plain_b;
    for (const Measured& m : some(count)) {
      sums.add(m.point, m.sample, m.seen, m.difference, m.weight);
      const double q = m.difference * m.difference / (kSigma * kSigma), w = m.weight / ((1 + q) * (1 + q));
      std::array<double, 8> row{};
      const auto by = jacobian.at(glm::dvec3(m.point));
      for (std::size_t i = 0; i < 6; ++i) row[i] = kPerUnit * (m.sample.dx * by[i].x + m.sample.dy * by[i].y);
      row[6] = -m.seen;
      row[7] = -1;
      for (int i = 0; i < 8; ++i) {
        plain_b[i] += w * row[i] * m.difference;
        for (int j = i; j < 8; ++j) plain_a(i, j) += w * row[i] * row[j];
      }
    }
    sums.finish(a, b);
    for (int i = 0; i < 8; ++i) {
      for (int j = i; j < 8; ++j) {
        const double scale = std::sqrt(plain_a(i, i) * plain_a(j, j));
        EXPECT_NEAR(a(i, j), plain_a(i, j), 1e-4 * scale) << count << ": " << i << ' ' << j;
      }
      EXPECT_NEAR(b[i], plain_b[i], 1e-3 * std::sqrt(plain_a(i, i)) * 40) << count << ": " << i;
    }
  }
}

TEST(AlignmentSums, OfNothingAreZero) {
  AlignmentSums sums(PoseJacobian(pose()), kPerUnit, kSigma);
  auto a = AlignmentSums::Matrix::zeros();
  AlignmentSums::Vector b;
  sums.finish(a, b);
  EXPECT_EQ(cv::norm(a), 0);
  EXPECT_EQ(cv::norm(b), 0);
}

}  // namespace
}  // namespace fbs
