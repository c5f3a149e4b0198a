#include "encoder/surround/keypoint.h"

#include <algorithm>

#include "encoder/surround/surround_tuning.h"

namespace fbs {

using namespace surround;

namespace {

constexpr int kRimPieces = 10;

/// The steepest place of the square at (x, y); false when all of it is flat.
bool find_steepest(const SurroundPyramid& first, int x, int y, Keypoint& keypoint) {
  float best = kMinSlope * kMinSlope;
  bool found = false;
  for (int v = y; v < y + kSquare; ++v) {
    for (int u = x; u < x + kSquare; ++u) {
      const glm::dvec2 at(u, v);
      Sample here, coarse;
      if (!sample_with_slope(first[0], at, here)) continue;
      const float steep = here.dx * here.dx + here.dy * here.dy;
      keypoint.structure[0] += here.dx * here.dx;
      keypoint.structure[1] += here.dx * here.dy;
      keypoint.structure[2] += here.dy * here.dy;
      if (steep <= best || !sample_with_slope(first[1], on_level(at, 1), coarse)) continue;
      best = steep;
      found = true;
      keypoint.at = at;
      keypoint.seen = {here, coarse};
    }
  }
  return found;
}

std::array<Keypoint::Quarter, 4> quarters_of(const cv::Mat& luma, int x, int y) {
  std::array<Keypoint::Quarter, 4> out;
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 at(x + kSquare / 2 * (i % 2), y + kSquare / 2 * (i / 2));
    out[i] = {at, static_cast<float>(luma.ptr(at.y)[at.x])};
  }
  return out;
}

/// Which piece of the rim, three along each side and four along the top; or none.
/// @param at  share of the picture's width and height
int rim_piece_at(glm::dvec2 at) {
  if (at.y < kRimWidth) return std::min(3, static_cast<int>(4 * at.x));
  if (at.y < kRimBottom && (at.x < kRimWidth || at.x > 1 - kRimWidth))
    return (at.x < 0.5 ? 4 : 7) + std::min(2, static_cast<int>(4 * at.y));
  return -1;
}

/// Keypoints without a layer.
std::vector<Keypoint> steepest_places(const SurroundPyramid& first, int factor, glm::dvec2 origin,
                                      double unit_px) {
  const cv::Mat& luma = first[0];
  std::vector<Keypoint> out;
  for (int y = kSquare / 2; y + kSquare < luma.rows; y += kSquare) {
    for (int x = kSquare / 2; x + kSquare < luma.cols; x += kSquare) {
      Keypoint keypoint;
      if (!find_steepest(first, x, y, keypoint)) continue;
      keypoint.place = (keypoint.at + 0.5) * static_cast<double>(factor);
      keypoint.from_head = (keypoint.place - origin) / unit_px;
      keypoint.quarters = quarters_of(luma, x, y);
      out.push_back(keypoint);
    }
  }
  return out;
}

}  // namespace

std::vector<Keypoint> select_keypoints(const SurroundPyramid& first, int factor, const Pose& seen) {
  const cv::Mat& luma = first[0];
  std::vector<Keypoint> out;
  for (Keypoint& keypoint : steepest_places(first, factor, seen.shift, seen.eye_distance_px())) {
    const LayerShares prior = layers_by_place(seen, keypoint.place);
    if (prior[kHeadLayer] > kMaxHeadPrior) continue;
    keypoint.layers = LayerMembership(prior);
    if (prior[kGroundLayer] > kMinGroundOnRim)
      keypoint.rim_piece = rim_piece_at((keypoint.at + 0.5) / glm::dvec2(luma.cols, luma.rows));
    out.push_back(keypoint);
  }
  return out;
}

std::vector<Keypoint> select_ground_keypoints(const SurroundPyramid& first, int factor, glm::dvec2 origin,
                                              double unit_px) {
  std::vector<Keypoint> out = steepest_places(first, factor, origin, unit_px);
  LayerShares ground{};
  ground[kGroundLayer] = 1;
  for (Keypoint& keypoint : out) keypoint.layers = LayerMembership(ground);
  return out;
}

bool ground_shows(std::span<const Keypoint> keypoints) {
  std::array<int, kRimPieces> in_piece{};
  for (const Keypoint& k : keypoints)
    if (k.on_rim()) ++in_piece[k.rim_piece];
  return std::count_if(in_piece.begin(), in_piece.end(), [](int n) { return n >= kMinRimKeypoints; }) >=
         kMinRimPieces;
}

}  // namespace fbs
