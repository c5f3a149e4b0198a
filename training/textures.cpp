#include "training/textures.h"

#include <opencv2/imgproc.hpp>
#include <random>
#include <string>

namespace fbs {
namespace {

constexpr int kSide = 192;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double any(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }
  int any(int from, int to) { return std::uniform_int_distribution<int>(from, to)(engine_); }

 private:
  std::mt19937 engine_;
};

cv::Mat1b grain(Random& random) {
  constexpr int kFinest = 1, kCoarsest = 48;  ///< pixels
  cv::Mat1f sum(kSide, kSide, static_cast<float>(random.any(60.0, 200.0)));
  for (int grain = kFinest; grain <= kCoarsest; grain *= 2) {
    if (random.any(0.0, 1.0) < 0.4) continue;
    cv::Mat1f noise(kSide / grain + 1, kSide / grain + 1), grown;
    cv::RNG(static_cast<std::uint64_t>(random.any(1, 1 << 30)))
        .fill(noise, cv::RNG::NORMAL, 0, random.any(5.0, 60.0));
    cv::resize(noise, grown, sum.size(), 0, 0, cv::INTER_CUBIC);
    sum += grown;
  }
  cv::Mat1b out;
  sum.convertTo(out, CV_8U);
  return out;
}

/// Lines of words as on a slide, bright on dark or dark on bright, and sometimes bars.
cv::Mat1b text(Random& random) {
  const bool dark = random.any(0, 2) == 0;
  const int paper = dark ? random.any(0, 70) : random.any(180, 255),
            ink = dark ? random.any(170, 255) : random.any(0, 90);
  cv::Mat1b out(kSide, kSide, static_cast<std::uint8_t>(paper));
  const double size = random.any(0.35, 1.6);
  const int font = random.any(cv::FONT_HERSHEY_SIMPLEX, cv::FONT_HERSHEY_SCRIPT_COMPLEX),
            width = random.any(1, 4);
  const double pitch = random.any(22.0, 45.0) * size;
  for (double y = pitch; y < kSide + pitch; y += pitch * random.any(0.9, 1.4)) {
    std::string line;
    for (int n = random.any(2, 24); n > 0; --n)
      line += random.any(0, 5) == 0 ? ' ' : static_cast<char>(random.any('!', 'z'));
    cv::putText(out, line, {random.any(-60, 60), static_cast<int>(y)}, font, size, cv::Scalar(ink), width,
                cv::LINE_AA);
  }
  for (int bars = random.any(0, 2) == 0 ? random.any(2, 6) : 0; bars > 0; --bars) {
    const int left = random.any(0, kSide - 10), high = random.any(10, kSide / 2);
    cv::rectangle(out, {left, kSide - high, random.any(6, 30), high}, cv::Scalar(random.any(0, 255)),
                  cv::FILLED);
  }
  return out;
}

}  // namespace

std::vector<cv::Mat1b> draw_textures(int count) {
  Random random(7);
  std::vector<cv::Mat1b> out;
  out.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) out.push_back(i % 4 == 0 ? grain(random) : text(random));
  return out;
}

}  // namespace fbs
