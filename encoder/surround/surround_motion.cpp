#include "encoder/surround/surround_motion.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "encoder/image/bilinear.h"
#include "encoder/image/planes.h"

namespace fbs {
namespace {

constexpr int kSquare = 4;        // work pixels; each gives one spot
constexpr float kLeastSlope = 3;  // grey levels per work pixel; flatter squares say nothing
constexpr double kOutlier = 16;   // grey levels; larger differences lose their say
constexpr double kNoise = 8;      // grey levels
constexpr int kSteps[] = {3, 2};  // per level, fine level first
constexpr double kMemory = 20;    // pictures over which it is learned what goes with what
constexpr double kEvidence = 3;   // how much more the pictures say than the place
// Standard deviations of a body's way about the ground's, and of a ground's about none; eye distances.
constexpr double kFar = 0.5, kGrows = 0.02;
// A part that rested moves once that leaves less than this of the difference; one that moved rests at more.
constexpr double kBegins = 0.8, kRests = 0.92;
constexpr double kLost = 0.6;       // of the difference at rest: a body that leaves more is looked for again
constexpr double kWorthMoving = 2;  // squared grey levels per spot

// A camera that moves is seen along the rim of the picture, at its sides and top; hair before an even wall,
// which moves too, is not there. The rim's width as a share of the picture, and how many of its ten pieces
// must show how many spots at least.
constexpr double kRim = 0.17;
constexpr int kRimPieces = 4, kRimSpots = 3;

double robust(double r) {
  const double q = r * r;
  return q / (1 + q / (kOutlier * kOutlier));
}

double robust_weight(double r) {
  const double d = 1 + r * r / (kOutlier * kOutlier);
  return 1 / (d * d);
}

/// Bilinear value, or a negative one outside.
double value_at(const cv::Mat& luma, glm::dvec2 p) {
  if (!(p.x >= 0 && p.y >= 0 && p.x < luma.cols - 1 && p.y < luma.rows - 1)) return -1;
  const int i = static_cast<int>(p.x), j = static_cast<int>(p.y);
  const double fx = p.x - i, fy = p.y - j;
  const std::uint8_t *a = luma.ptr(j) + i, *b = luma.ptr(j + 1) + i;
  return (a[0] * (1 - fx) + a[1] * fx) * (1 - fy) + (b[0] * (1 - fx) + b[1] * fx) * fy;
}

std::array<cv::Mat, 2> two_levels(const Picture& picture, int factor) {
  std::array<cv::Mat, 2> out;
  const cv::Mat whole = view(picture.y);
  if (factor == 1)
    whole.copyTo(out[0]);
  else
    cv::resize(whole, out[0], {whole.cols / factor, whole.rows / factor}, 0, 0, cv::INTER_AREA);
  cv::pyrDown(out[0], out[1]);
  return out;
}

}  // namespace

std::array<float, 3> layers_by_place(const Pose& seen, glm::dvec2 place) {
  const double c = std::cos(seen.roll), s = std::sin(seen.roll);
  const glm::dvec2 d = (place - seen.shift) / seen.eye_distance_px();
  const glm::dvec2 own(c * d.x + s * d.y, -s * d.x + c * d.y);
  const double r = std::hypot(own.x / 1.45, (own.y - 0.3) / 1.95);
  const double head = std::clamp(2.3 - 1.3 * r, 0.0, 1.0);
  // Neck and shoulders: below a line that falls away from the chin, and steeper beyond the arms.
  const double x = std::abs(own.x);
  const double line = 1.8 + 0.4 * x + 2 * std::max(0.0, x - 2.8);
  const double body = std::clamp(0.5 + (own.y - line) / 1.2, 0.04, 0.96);
  return {static_cast<float>(head), static_cast<float>((1 - head) * body),
          static_cast<float>((1 - head) * (1 - body))};
}

SurroundMotion::SurroundMotion(const Picture& first, const State& seen)
    : seen_(pose_of(seen)), eye_px_(seen_.eye_distance_px()), width_(first.width()), height_(first.height()) {
  factor_ = (std::max(width_, height_) + kLongSide - 1) / kLongSide;
  luma_ = two_levels(first, factor_);
  std::array<int, 10> on_rim{};
  for (int y = kSquare / 2; y + kSquare < luma_[0].rows; y += kSquare) {
    for (int x = kSquare / 2; x + kSquare < luma_[0].cols; x += kSquare) {
      Spot spot;
      float best = kLeastSlope * kLeastSlope;
      bool any = false;
      for (int v = y; v < y + kSquare; ++v) {
        for (int u = x; u < x + kSquare; ++u) {
          Sample here;
          if (!sample_with_slope(luma_[0], glm::dvec2(u, v), here)) continue;
          const float steep = here.dx * here.dx + here.dy * here.dy;
          spot.steepness[0] += here.dx * here.dx;
          spot.steepness[1] += here.dx * here.dy;
          spot.steepness[2] += here.dy * here.dy;
          Sample coarse;
          if (steep <= best || !sample_with_slope(luma_[1], glm::dvec2(u, v) / 2.0, coarse)) continue;
          best = steep;
          any = true;
          spot.at = {u, v};
          spot.look = {Look{here.value, here.dx, here.dy}, Look{coarse.value, coarse.dx, coarse.dy}};
        }
      }
      if (!any) continue;
      spot.from_head = ((spot.at + 0.5) * static_cast<double>(factor_) - seen_.shift) / eye_px_;
      spot.prior = layers_by_place(seen_, (spot.at + 0.5) * static_cast<double>(factor_));
      if (spot.prior[kHeadLayer] > 0.99F) continue;
      spot.share = spot.prior;
      weigh(spot);
      // Pieces of the rim: three along each side, four along the top.
      const double u = (spot.at.x + 0.5) / luma_[0].cols, v = (spot.at.y + 0.5) / luma_[0].rows;
      int piece = -1;
      if (v < kRim)
        piece = std::min(3, static_cast<int>(4 * u));
      else if (v < 0.75 && (u < kRim || u > 1 - kRim))
        piece = (u < 0.5 ? 4 : 7) + std::min(2, static_cast<int>(4 * v));
      spot.rim = piece >= 0 && spot.prior[kGroundLayer] > 0.5F;
      if (spot.rim) ++on_rim[piece];
      spots_.push_back(spot);
    }
  }
  ground_shows_ =
      std::count_if(on_rim.begin(), on_rim.end(), [](int n) { return n >= kRimSpots; }) >= kRimPieces;
}

glm::dvec2 SurroundMotion::way_of(const Spot& spot, const Flat& f) const {
  const glm::dvec2 d = spot.from_head;
  return glm::dvec2(f[kDisplacementX] + f[kSimilarityScale] * d.x - f[kSimilarityRotation] * d.y,
                    f[kDisplacementY] + f[kSimilarityScale] * d.y + f[kSimilarityRotation] * d.x) /
         static_cast<double>(factor_);
}

SurroundMotion::Flat SurroundMotion::aligned(Layer layer, const Flat& start, const Flat& near) const {
  Flat flat = start;
  const Flat sigma = {kFar * eye_px_, kFar * eye_px_, kGrows * eye_px_, kGrows * eye_px_};
  for (int level = kLevels - 1; level >= 0; --level) {
    const double to_level = 1.0 / (1 << level);
    const double slope_unit = to_level / factor_;  // picture pixels to pixels of the level
    const auto l = static_cast<std::size_t>(level);
    for (int step = 0; step < kSteps[level]; ++step) {
      cv::Matx44d left = cv::Matx44d::zeros();
      cv::Vec4d right(0, 0, 0, 0);
      for (int i = 0; i < kSimilarityCount; ++i) {
        const auto k = static_cast<std::size_t>(i);
        left(i, i) = 1 / (sigma[k] * sigma[k]);
        right(i) = (near[k] - flat[k]) * left(i, i);
      }
      for (const Spot& spot : spots_) {
        const auto mine = static_cast<double>(spot.weight[layer]);
        if (mine < 0.1) continue;
        const double now = value_at(luma_[l], (spot.at + way_of(spot, flat)) * to_level);
        if (now < 0) continue;
        const double r = now - static_cast<double>(spot.look[l].value);
        const double w = mine * robust_weight(r) / (kNoise * kNoise);
        const double dx = static_cast<double>(spot.look[l].dx) * slope_unit,
                     dy = static_cast<double>(spot.look[l].dy) * slope_unit;
        const glm::dvec2 d = spot.from_head;
        const double by[4] = {dx, dy, dx * d.x + dy * d.y, dy * d.x - dx * d.y};
        for (int i = 0; i < 4; ++i) {
          right(i) -= w * by[i] * r;
          for (int j = i; j < 4; ++j) left(i, j) += w * by[i] * by[j];
        }
      }
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) left(i, j) = left(j, i);
      cv::Vec4d x;
      if (!cv::solve(left, right, x, cv::DECOMP_CHOLESKY)) return start;
      for (int i = 0; i < 4; ++i) flat[i] += x(i);
    }
  }
  return flat;
}

double SurroundMotion::difference(Layer layer, const Flat& flat, bool rim) const {
  double sum = 0, weights = 0;
  for (const Spot& spot : spots_) {
    const auto mine = static_cast<double>(spot.weight[layer]);
    if (mine < 0.1 || (rim && !spot.rim)) continue;
    const double now = value_at(luma_[0], spot.at + way_of(spot, flat));
    if (now < 0) continue;
    sum += mine * robust(now - static_cast<double>(spot.look[0].value));
    weights += mine;
  }
  return weights > 0 ? sum / weights : 0;
}

void SurroundMotion::weigh(Spot& spot) const {
  const float least = *std::min_element(spot.against.begin(), spot.against.end());
  float sum = 0;
  for (std::size_t l = 0; l < kLayers; ++l) {
    spot.weight[l] = spot.prior[l] * std::exp(-static_cast<float>(kEvidence / (2 * kNoise * kNoise)) *
                                              (spot.against[l] - least));
    sum += spot.weight[l];
  }
  for (float& w : spot.weight) w /= std::max(sum, 1e-6F);
}

void SurroundMotion::learn(const Pose& head) {
  const PoseProjection was(seen_), is(head);
  const glm::dmat2 a(glm::dvec2(was.matrix[0]), glm::dvec2(was.matrix[1])),
      b(glm::dvec2(is.matrix[0]), glm::dvec2(is.matrix[1]));
  const double det = a[0][0] * a[1][1] - a[1][0] * a[0][1];
  if (std::abs(det) < 1e-12) return;
  const glm::dmat2 turned = b * (glm::dmat2(a[1][1], -a[0][1], -a[1][0], a[0][0]) / det);
  const float fresh = static_cast<float>(1 / std::min<double>(kMemory, ++pictures_));
  for (Spot& spot : spots_) {
    const glm::dvec2 p = (spot.at + 0.5) * static_cast<double>(factor_);
    const std::array<glm::dvec2, kLayers> way = {
        (turned * (p - seen_.shift) + head.shift - p) / static_cast<double>(factor_),
        way_of(spot, shown_body_), way_of(spot, shown_ground_)};
    for (std::size_t l = 0; l < kLayers; ++l) {
      const double now = value_at(luma_[0], spot.at + way[l]);
      const double r = now < 0 ? 0 : now - static_cast<double>(spot.look[0].value);
      spot.fits_now[l] = now < 0 ? 0.0F : static_cast<float>(robust_weight(r));
      if (now >= 0) spot.against[l] += fresh * (static_cast<float>(robust(r)) - spot.against[l]);
    }
    weigh(spot);
  }
}

SurroundMotion::Flat SurroundMotion::found_body(const Flat& rest, glm::dvec2 head_way) const {
  Flat best = aligned(kBodyLayer, body_, rest);
  double least = difference(kBodyLayer, best);
  if (least < kLost * difference(kBodyLayer, rest)) return best;
  for (const Flat& start : {rest, Flat{0.5 * head_way.x, 0.5 * head_way.y, 0, 0}}) {
    const Flat flat = aligned(kBodyLayer, start, rest);
    if (const double d = difference(kBodyLayer, flat); d < least) {
      least = d;
      best = flat;
    }
  }
  return best;
}

void SurroundMotion::look_at(const Picture& picture, const Pose& head) {
  luma_ = two_levels(picture, factor_);
  const Flat none{};
  const auto explains = [&](Layer layer, const Flat& rest, const Flat& way, bool moves) {
    const bool rim = layer == kGroundLayer && ground_shows_;
    const double still = difference(layer, rest, rim), moved = difference(layer, way, rim);
    return moved < (moves ? kRests : kBegins) * still && (moves || still - moved > kWorthMoving);
  };
  // Where the ground does not show, it is free to go with what neither head nor body explains: long hair
  // before an even wall (woman_presenter_700: 24.1 -> 25.8 dB).
  ground_ = aligned(kGroundLayer, ground_, none);
  ground_moves_ = explains(kGroundLayer, none, ground_, ground_moves_);
  shown_ground_ = ground_moves_ ? ground_ : none;
  const Flat& rest = ground_shows_ ? shown_ground_ : none;
  body_ = found_body(rest, head.shift - seen_.shift);
  body_moves_ = explains(kBodyLayer, rest, body_, body_moves_);
  shown_body_ = body_moves_ ? body_ : rest;
  learn(head);
}

void SurroundMotion::believe(const SurroundMap& map) {
  mapped_ = true;
  for (Spot& spot : spots_) {
    const glm::dvec2 at = (spot.at + 0.5) * static_cast<double>(factor_);
    const double x = std::clamp(at.x / width_ * map.columns, 0.0, map.columns - 1e-6),
                 y = std::clamp(at.y / height_ * map.rows, 0.0, map.rows - 1e-6);
    const int c = static_cast<int>(x), r = static_cast<int>(y);
    double head = 0, body = 0;
    for (int dr = 0; dr < 2; ++dr) {
      for (int dc = 0; dc < 2; ++dc) {
        const auto k = static_cast<std::size_t>((r + dr) * (map.columns + 1) + c + dc);
        const double w = (dc == 0 ? 1 - (x - c) : x - c) * (dr == 0 ? 1 - (y - r) : y - r);
        const double h = static_cast<double>(map.head[k]) / kFollowOne;
        head += w * h;
        body += w * (1 - h) * static_cast<double>(map.body[k]) / kFollowOne;
      }
    }
    spot.share = {static_cast<float>(head), static_cast<float>(body), static_cast<float>(1 - head - body)};
    for (std::size_t l = 0; l < kLayers; ++l) spot.prior[l] = 0.05F + spot.share[l];
    weigh(spot);
  }
}

void SurroundMotion::add_to(State& state) const {
  for (std::size_t i = 0; i < kSimilarityCount; ++i) {
    state.body[i] = static_cast<std::int32_t>(std::lround(64 * shown_body_[i]));
    state.ground[i] = static_cast<std::int32_t>(std::lround(64 * shown_ground_[i]));
  }
}

void SurroundMotion::add_to(PictureCost& cost) const {
  // A square of the work picture stands for factor^2 times as many samples, whose slopes are as much less.
  double rise[8][8] = {};
  for (const Spot& spot : spots_) {
    const std::array<float, kLayers>& share = mapped_ ? spot.share : spot.weight;
    const std::size_t most =
        static_cast<std::size_t>(std::max_element(share.begin(), share.end()) - share.begin());
    const auto visible = static_cast<double>(spot.fits_now[most]);
    const auto xx = static_cast<double>(spot.steepness[0]), xy = static_cast<double>(spot.steepness[1]),
               yy = static_cast<double>(spot.steepness[2]);
    const glm::dvec2 d = spot.from_head;
    const double by_x[4] = {1, 0, d.x, -d.y}, by_y[4] = {0, 1, d.y, d.x};
    double one[4][4];
    for (int i = 0; i < 4; ++i)
      for (int j = i; j < 4; ++j)
        one[i][j] = visible * (xx * by_x[i] * by_x[j] + xy * (by_x[i] * by_y[j] + by_y[i] * by_x[j]) +
                               yy * by_y[i] * by_y[j]);
    const double part[2] = {static_cast<double>(share[kBodyLayer]), static_cast<double>(share[kGroundLayer])};
    for (int a = 0; a < 2; ++a)
      for (int b = a; b < 2; ++b)
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j)
            rise[4 * a + i][4 * b + j] += part[a] * part[b] * one[std::min(i, j)][std::max(i, j)];
  }
  constexpr int kFirst = first_of(PartId::kBody);
  static_assert(first_of(PartId::kGround) == kFirst + kSimilarityCount);
  RegionCost of{Region::kSurround, 0, 0, cv::Mat1d::zeros(kParameterCount, kParameterCount)};
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      of.quadratic(kFirst + i, kFirst + j) = rise[std::min(i, j)][std::max(i, j)] / (64 * 64);
  cost.regions.push_back(std::move(of));
  for (std::size_t i = 0; i < kSimilarityCount; ++i) {
    cost.fit[kFirst + i] = 64 * shown_body_[i];
    cost.fit[kFirst + kSimilarityCount + i] = 64 * shown_ground_[i];
  }
}

}  // namespace fbs
