#include "training/augmentation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace fbs {
namespace {

class Dice {
 public:
  explicit Dice(std::mt19937& random) : random_(random) {}
  float normal(float deviation) { return std::normal_distribution<float>(0, deviation)(random_); }
  float uniform(float from, float to) { return std::uniform_real_distribution<float>(from, to)(random_); }
  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }
  /// With noise of a deviation; faster by far than one number at a time.
  void fill(cv::Mat1f& noise, float deviation) {
    cv::RNG(random_()).fill(noise, cv::RNG::NORMAL, 0, deviation);
  }
  bool chance(float probability) { return uniform(0, 1) < probability; }

 private:
  std::mt19937& random_;
};

/// Mirrors, turns and stretches the plane so that the place comes to lie about the patch's middle.
cv::Matx33f plane_map(const FacePlace& place, const PlaceNoise& noise, bool mirror, Dice& dice) {
  constexpr float kMiddle = kPatchSide / 2.F;
  const glm::vec2 centre(place.centre);
  const float scale =
      kPatchEyeDistance / static_cast<float>(place.eye_distance_px) * std::exp(dice.normal(noise.scale));
  const float roll = dice.normal(0.15F), shear = dice.normal(0.05F);
  const float wide = std::exp(dice.normal(0.05F)), high = std::exp(dice.normal(0.05F));
  const float c = std::cos(roll), s = std::sin(roll);
  const cv::Matx33f to_origin(1, 0, -centre.x, 0, 1, -centre.y, 0, 0, 1);
  const cv::Matx33f stretched((mirror ? -1.F : 1.F) * wide, shear, 0, 0, high, 0, 0, 0, 1);
  const cv::Matx33f turned(scale * c, -scale * s, kMiddle + dice.normal(noise.shift * kPatchEyeDistance),
                           scale * s, scale * c, kMiddle + dice.normal(noise.shift * kPatchEyeDistance), 0, 0,
                           1);
  return turned * stretched * to_origin;
}

cv::Mat1f drawn(const cv::Mat1b& luma, const cv::Matx33f& map, Dice& dice) {
  const float scale = std::sqrt(std::abs(map(0, 0) * map(1, 1) - map(0, 1) * map(1, 0)));
  cv::Mat source = luma, blurred;
  if (scale < 1) {
    cv::GaussianBlur(luma, blurred, {}, 0.4 / scale);
    source = blurred;
  }
  // From positions to OpenCV's indices and back: pixels' centres are at their half.
  const cv::Matx33f to_position(1, 0, 0.5F, 0, 1, 0.5F, 0, 0, 1), to_index(1, 0, -0.5F, 0, 1, -0.5F, 0, 0, 1);
  const cv::Matx33f indices = to_index * map * to_position;
  constexpr int kBorders[] = {cv::BORDER_REPLICATE, cv::BORDER_REFLECT, cv::BORDER_CONSTANT};
  cv::Mat out;
  cv::warpAffine(source, out, indices.get_minor<2, 3>(0, 0), {kPatchSide, kPatchSide}, cv::INTER_LINEAR,
                 kBorders[dice.below(3)], cv::Scalar(dice.below(256)));
  out.convertTo(out, CV_32F);
  return cv::Mat1f(out);
}

void light(cv::Mat1f& patch, Dice& dice) {
  if (dice.chance(0.5F)) {
    cv::pow(cv::max(patch, 0.F) / 255, std::exp(dice.normal(0.35F)), patch);
    patch *= 255;
  }
  if (dice.chance(0.3F)) {  // from a side
    const float angle = dice.uniform(0, 2 * std::numbers::pi_v<float>), strength = dice.uniform(0, 0.5F);
    constexpr float kMiddle = kPatchSide / 2.F;
    for (int y = 0; y < patch.rows; ++y)
      for (int x = 0; x < patch.cols; ++x) {
        const float along = (static_cast<float>(x) - kMiddle) * std::cos(angle) +
                            (static_cast<float>(y) - kMiddle) * std::sin(angle);
        patch(y, x) *= 1 + strength * std::clamp(along / 80, -1.F, 1.F);
      }
  }
  patch = (patch - 128) * std::exp(dice.normal(0.25F)) + 128 + dice.normal(15);
}

void blur(cv::Mat1f& patch, Dice& dice) {
  if (dice.chance(0.4F)) cv::GaussianBlur(patch, patch, {}, dice.uniform(0.5F, 4));
  if (dice.chance(0.3F)) {  // seen from afar
    cv::Mat small;
    const double share = 1 / dice.uniform(1.5F, 5);
    cv::resize(patch, small, {}, share, share, cv::INTER_AREA);
    cv::resize(small, patch, patch.size());
  }
}

void disturb(cv::Mat1f& patch, const Shape& truth, Dice& dice) {
  if (dice.chance(0.5F)) {
    cv::Mat1f noise(patch.size());
    dice.fill(noise, dice.uniform(0, 8));
    patch += noise;
  }
  if (dice.chance(0.15F)) {  // something before the face
    const glm::vec2 at = truth[static_cast<std::size_t>(dice.below(kLandmarkCount))];
    const cv::Rect cover(static_cast<int>(at.x - dice.uniform(0, 40)),
                         static_cast<int>(at.y - dice.uniform(0, 40)), 10 + dice.below(30),
                         10 + dice.below(30));
    patch(cover & cv::Rect({}, patch.size())).setTo(dice.uniform(0, 255));
  }
}

}  // namespace

PatchSample as_it_is(const FacePicture& face, const PlaceNoise& noise, std::mt19937& random) {
  Dice dice(random);
  const float eye = eye_distance(face.landmarks);
  const glm::vec2 off(dice.normal(noise.shift * eye), dice.normal(noise.shift * eye));
  const FacePatch patch(face.luma, {mean_of(face.landmarks) + off, eye * std::exp(dice.normal(noise.scale))});
  PatchSample out{patch.luma(), {}};
  std::ranges::transform(face.landmarks, out.truth.begin(),
                         [&patch](glm::vec2 p) { return patch.to_patch(p); });
  return out;
}

PatchSample augmented(const FacePicture& face, const FacePlace& place, const PlaceNoise& noise,
                      std::mt19937& random) {
  Dice dice(random);
  const bool mirror = dice.chance(0.5F);
  const cv::Matx33f map = plane_map(place, noise, mirror, dice);
  PatchSample out;
  for (int k = 0; k < kLandmarkCount; ++k) {
    const glm::vec2 p = face.landmarks[static_cast<std::size_t>(mirror ? mirrored_landmark(k) : k)];
    const cv::Vec3f at = map * cv::Vec3f(p.x, p.y, 1);
    out.truth[static_cast<std::size_t>(k)] = {at[0], at[1]};
  }
  cv::Mat1f patch = drawn(face.luma, map, dice);
  light(patch, dice);
  blur(patch, dice);
  disturb(patch, out.truth, dice);
  patch.convertTo(out.patch, CV_8U);
  return out;
}

}  // namespace fbs
