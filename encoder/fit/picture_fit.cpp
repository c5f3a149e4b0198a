#include "encoder/fit/picture_fit.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "encoder/image/bilinear.h"
#include "encoder/model/expression_prior.h"
#include "encoder/model/pose_jacobian.h"

namespace fbs {
namespace {

constexpr double kPointSpacing = 2.5;  // work pixels
constexpr int kMouthRows = 5;
constexpr double kNoise = 6;   // grey levels: what differs by this much is as likely as not meant
constexpr double kHuber = 48;  // grey levels; larger differences (teeth, shadows) pull with constant force
// Standard deviations of what is believed before looking, as shares of the eye distance or radians.
constexpr double kPoseNear =
    0.006;  // of the tracked pose, which is aligned to the same picture with less to say
constexpr double kOuterLipNear =
    0.012;  // of the tracked control points, by feature: contours show lips and lids
constexpr double kInnerLipNear = 0.005;  // better than textures do, and textures show brows better
constexpr double kBrowNear = 0.034;
constexpr double kLidNear = 0.007;
constexpr double kElseNear = 0.034;
constexpr double kLightNear = 4;  // grey levels: of the light in the picture before
constexpr double kLightRest = 40;
constexpr double kInsideNear = 8;  // the same for the mouth's inside
constexpr double kInsideRest = 30;
constexpr double kControlRest = 0.12;  // of control points about rest
// Of lids, in shares of their travel.
constexpr double kClosings[] = {-0.3, 0, 0.2, 0.4, 0.6, 0.8, 1};
constexpr double kLidsAlike = 60;  // squared grey levels that a difference of one costs
constexpr double kLidNoise = 30;   // grey levels; larger differences hardly count more
// Eye distances by which a shut upper lid passes the lower one, so that nothing of the eye is left between.
constexpr double kLidsApart = -0.01;
constexpr double kInnerLipsStray = 0.04;  // eye distances
constexpr int kSteps[] = {3, 2};          // per level, fine level first
constexpr double kMaxOffset = 0.35 * kUnitsPerEyeDistance;

std::array<cv::Mat, 2> two_levels(const cv::Mat& luma) {
  std::array<cv::Mat, 2> out{luma, {}};
  cv::pyrDown(luma, out[1]);
  return out;
}

glm::dvec2 on_level(glm::dvec2 work, int level) {
  return work / static_cast<double>(1 << level);
}

bool belongs_to(int control, FeatureId first, FeatureId last) {
  const Feature &from = feature(first), &to = feature(last);
  return control >= from.first_control && control < to.first_control + to.control_count;
}

double near_of(int control) {
  if (belongs_to(control, FeatureId::kMouthOuter, FeatureId::kMouthOuter)) return kOuterLipNear;
  if (belongs_to(control, FeatureId::kMouthInner, FeatureId::kMouthInner)) return kInnerLipNear;
  if (belongs_to(control, FeatureId::kBrowRight, FeatureId::kBrowLeft)) return kBrowNear;
  if (belongs_to(control, FeatureId::kUpperLidRight, FeatureId::kUpperLidLeft)) return kLidNear;
  return kElseNear;
}

/// Squared, and from kHuber on linear.
double huber(double difference) {
  const double r = std::abs(difference);
  return r < kHuber ? r * r : kHuber * (2 * r - kHuber);
}

/// Area of a triangle on the screen; zero when it faces away.
double visible_area(glm::dvec2 p, glm::dvec2 q, glm::dvec2 r) {
  const glm::dvec2 a = q - p, b = r - p;
  return std::max(0.0, 0.5 * (a.x * b.y - a.y * b.x));
}

/// Normal equations of the points of one triangle, which few control points move: dense, in single precision.
constexpr std::size_t kMostColumns = kPoseCount + kLightCount + kInteriorCount + 2 * kControlCount;
struct Block {
  std::size_t n = 0;
  alignas(32) std::array<float, kMostColumns> row;
  alignas(32) std::array<float, kMostColumns> right;
  alignas(32) std::array<float, kMostColumns * kMostColumns> left;  // upper triangle

  void begin(std::size_t columns) {
    n = columns;
    std::fill_n(right.begin(), n, 0.0F);
    for (std::size_t i = 0; i < n; ++i)
      std::fill_n(left.begin() + static_cast<std::ptrdiff_t>(i * kMostColumns), n, 0.0F);
  }

  /// @param r  residual of `row`
  void add(float weight, float r) {
    for (std::size_t i = 0; i < n; ++i) {
      const float wi = weight * row[i];
      right[i] += wi * r;
      float* out = &left[i * kMostColumns];
      for (std::size_t j = i; j < n; ++j) out[j] += wi * row[j];
    }
  }
};

}  // namespace

PictureFit::PictureFit(const Setup& setup, const Geometry& geometry, const WorkFrame& pattern,
                       const State& seen)
    : geometry_(geometry), column_(kControlCount, -1) {
  const GenericHead& head = generic_head();
  for (std::size_t p = 0; p < kExpressionPartCount; ++p) {
    if ((setup.parts >> (kFirstExpressionPart + static_cast<int>(p)) & 1) == 0) continue;
    for (int c = 0; c < head.expression[p].control_count; ++c) {
      column_[head.expression[p].first_control + c] = unknowns_;
      unknowns_ += 2;
    }
  }
  const Fit rest{pose_of(seen), {}, {}, {}};
  const HeadVertices vertices = deformed(rest);
  const PoseProjection projection(rest.pose);
  const double spacing = kPointSpacing / pattern.scale;
  points_ = spread_over_mesh(vertices, projection, spacing, kMouthRows);
  points_on_triangle_.assign(head.triangles.size(), 0);
  for (const SurfacePoint& p : points_) {
    ++points_on_triangle_[p.triangle];
    const bool inside_mouth = std::all_of(p.corner.begin(), p.corner.end(), is_inner_lip);
    float ramp = -1;
    if (inside_mouth) {
      ramp = 0;
      for (std::size_t k = 0; k < 3; ++k)
        ramp += p.barycentric[k] * static_cast<float>(mouth_ramp(p.corner[k])) / 256;
    }
    mouth_ramp_.push_back(ramp);
  }
  gap_seen_ = mouth_gap(deform(geometry_.positions, seen));
  for (const SurfacePoint& p : points_)
    rest_.push_back(glm::dvec2(p.on(vertices)) / static_cast<double>(kUnitsPerEyeDistance));
  for (std::size_t k = 0; k < points_.size();) {
    std::size_t end = k;
    while (end < points_.size() && points_[end].triangle == points_[k].triangle) ++end;
    patches_.push_back(patch_of(k, end));
    k = end;
  }
  lids_ = {lid_of(FeatureId::kUpperLidRight, 40), lid_of(FeatureId::kUpperLidLeft, 46)};
  const auto luma = two_levels(pattern.luma);
  for (int level = 0; level < kLevels; ++level) {
    for (const SurfacePoint& p : points_) {
      Sample s;
      const glm::dvec2 at = on_level(pattern.to_work(projection(p.on(vertices))), level);
      const bool inside = sample_with_slope(luma[level], at, s);
      pattern_luma_[level].push_back(inside ? static_cast<float>(s.value) : -1.0F);
    }
  }
}

PictureFit::Patch PictureFit::patch_of(std::size_t first, std::size_t end) const {
  const GenericHead& head = generic_head();
  const auto& corner = points_[first].corner;
  Patch patch{first, end, {}, {}};
  // Of each corner and control point.
  std::array<std::array<double, kControlCount>, 3> weight{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto v = static_cast<std::size_t>(corner[i]);
    for (std::size_t w = head.skinning_begin[v]; w < head.skinning_begin[v + 1]; ++w)
      weight[i][head.skinning[w].control] = head.skinning[w].weight / static_cast<double>(kSkinningOne);
  }
  for (std::size_t c = 0; c < kControlCount; ++c)
    if (column_[c] >= 0 &&
        std::max({std::abs(weight[0][c]), std::abs(weight[1][c]), std::abs(weight[2][c])}) > 0.01)
      patch.controls.push_back(static_cast<std::int16_t>(c));
  for (std::size_t k = first; k < end; ++k)
    for (const std::int16_t control : patch.controls) {
      double share = 0;
      for (std::size_t i = 0; i < 3; ++i)
        share += static_cast<double>(points_[k].barycentric[i]) * weight[i][control];
      patch.shares.push_back(static_cast<float>(share));
    }
  return patch;
}

PictureFit::Lid PictureFit::lid_of(FeatureId id, int lower_landmark) const {
  const Feature& f = feature(id);
  Lid lid;
  lid.first_control = f.first_control;
  double upper = 0, lower = 0;
  for (const FeatureVertex& fv : f.vertices) upper += geometry_.positions[fv.vertex].y;
  for (const int k : {lower_landmark, lower_landmark + 1}) {
    const std::size_t v = vertex_of_landmark(k);
    lower += geometry_.positions[v].y;
  }
  // Both free control points of the cubic have two thirds of the say at its vertices.
  lid.travel = 1.5 * (0.5 * (lower - upper) - kLidsApart * kUnitsPerEyeDistance);
  for (const Patch& patch : patches_) {
    const float* share = patch.shares.data();
    for (std::size_t k = patch.first; k < patch.end; ++k, share += patch.controls.size()) {
      bool moved = false;
      for (std::size_t i = 0; i < patch.controls.size(); ++i) {
        const auto c = static_cast<std::size_t>(patch.controls[i]);
        moved = moved || ((c == lid.first_control || c == lid.first_control + 1) && share[i] > 0.05F);
      }
      if (moved) lid.points.push_back(k);
    }
  }
  return lid;
}

double PictureFit::lid_difference(const Lid& lid, const Fit& fit) const {
  constexpr int kLevel = 1;
  const HeadVertices vertices = deformed(fit);
  const PoseProjection projection(fit.pose);
  const cv::Mat& luma = luma_[kLevel];
  double sum = 0, weights = 0, weight = 0;
  std::int16_t triangle = -1;
  for (const std::size_t k : lid.points) {
    const SurfacePoint& p = points_[k];
    if (p.triangle != triangle) {
      triangle = p.triangle;
      const auto corner = [&](std::size_t i) { return projection(vertices[p.corner[i]]); };
      weight = visible_area(corner(0), corner(1), corner(2)) / points_on_triangle_[triangle];
    }
    const double value = shown(k, kLevel, 0, fit);
    Sample s;
    if (weight <= 0 || value < 0 ||
        !sample_with_slope(luma, on_level(picture_.to_work(projection(p.on(vertices))), kLevel), s))
      continue;
    const double r = (value - s.value) * (value - s.value);
    sum += weight * r / (1 + r / (kLidNoise * kLidNoise));
    weights += weight;
  }
  return weights > 0 ? sum / weights : 0;
}

Fit PictureFit::with_best_lids(const Fit& start) const {
  if (column_[lids_[0].first_control] < 0) return start;
  constexpr std::size_t kCandidates = std::size(kClosings) + 1;  // the last: as it is
  const auto closed = [&](const Lid& lid, std::size_t candidate, Fit fit) {
    if (candidate < std::size(kClosings))
      for (std::size_t c = lid.first_control; c < lid.first_control + 2; ++c)
        fit.offsets[c] = {0, kClosings[candidate] * lid.travel};
    return fit;
  };
  std::array<std::array<double, kCandidates>, 2> difference{}, closing{};
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const Lid& lid = lids_[eye];
    for (std::size_t i = 0; i < kCandidates; ++i) {
      const Fit fit = closed(lid, i, start);
      difference[eye][i] = lid_difference(lid, fit);
      closing[eye][i] =
          0.5 * (fit.offsets[lid.first_control].y + fit.offsets[lid.first_control + 1].y) / lid.travel;
    }
  }
  double best = 1e30;
  std::array<std::size_t, 2> chosen{};
  for (std::size_t i = 0; i < kCandidates; ++i) {
    for (std::size_t j = 0; j < kCandidates; ++j) {
      const double apart = closing[0][i] - closing[1][j];
      const double cost = difference[0][i] + difference[1][j] + kLidsAlike * apart * apart;
      if (cost < best) {
        best = cost;
        chosen = {i, j};
      }
    }
  }
  return closed(lids_[1], chosen[1], closed(lids_[0], chosen[0], start));
}

std::array<double, kLightCount> PictureFit::light_at(std::size_t point, double pattern) const {
  const glm::dvec2 p = rest_[point];
  const double v = p.y - kFaceMiddle / static_cast<double>(kUnitsPerEyeDistance);
  return {1, (pattern - 128) / 64, p.x, p.y, p.x * p.x, v * v, p.x * v};
}

std::array<double, kInteriorCount> PictureFit::inside_at(double ramp) {
  return {std::max(0.0, 1 - 2 * ramp), 1 - std::abs(2 * ramp - 1), std::max(0.0, 2 * ramp - 1)};
}

double PictureFit::shown(std::size_t point, int level, std::int32_t shade, const Fit& fit) const {
  double value = static_cast<double>(pattern_luma_[level][point]);
  if (value < 0) return value;
  const auto light = light_at(point, value);
  for (std::size_t i = 0; i < kLightCount; ++i) value += fit.light[i] * light[i];
  value = std::clamp(value, 0.0, 255.0);
  const double ramp = static_cast<double>(mouth_ramp_[point]);
  if (ramp < 0 || shade == 0) return value;
  const auto shares = inside_at(ramp);
  const double upper = mouth_.upper.y, lower = mouth_.lower.y;
  const std::array<double, kInteriorCount> luma = {upper, 0.5 * (upper + lower), lower};
  double inside = 0;
  for (std::size_t i = 0; i < kInteriorCount; ++i) inside += shares[i] * (luma[i] + fit.interior[i]);
  return (value * (256 - shade) + inside * shade) / 256;
}

void PictureFit::look_at(const WorkFrame& picture, const MouthInterior& mouth) {
  mouth_ = mouth;
  picture_ = picture;
  luma_ = two_levels(picture.luma);
}

HeadVertices PictureFit::deformed(const Fit& fit) const {
  const GenericHead& head = generic_head();
  HeadVertices out;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    glm::dvec2 d(0);
    for (std::size_t k = head.skinning_begin[v]; k < head.skinning_begin[v + 1]; ++k)
      d += static_cast<double>(head.skinning[k].weight) * fit.offsets[head.skinning[k].control];
    out[v] = glm::dvec3(geometry_.positions[v]) + glm::dvec3(d / static_cast<double>(kSkinningOne), 0);
  }
  return out;
}

void PictureFit::add_priors(const Fit& start, const Fit& fit, Normal& normal) const {
  const double eye = fit.pose.eye_distance_px();
  const auto believe = [&](std::size_t k, double away, double sigma) {
    normal.at(k, k) += 1 / (sigma * sigma);
    normal.right[k] -= away / (sigma * sigma);
  };
  believe(0, fit.pose.pitch - start.pose.pitch, kPoseNear);
  believe(1, fit.pose.yaw - start.pose.yaw, kPoseNear);
  believe(2, fit.pose.roll - start.pose.roll, kPoseNear);
  believe(3, fit.pose.shift.x - start.pose.shift.x, kPoseNear * eye);
  believe(4, fit.pose.shift.y - start.pose.shift.y, kPoseNear * eye);
  believe(5, fit.pose.log2_scale - start.pose.log2_scale, kPoseNear);
  for (std::size_t i = 0; i < kLightCount; ++i) {
    believe(kPoseCount + i, fit.light[i] - start.light[i], kLightNear);
    believe(kPoseCount + i, fit.light[i], kLightRest);
  }
  for (std::size_t i = 0; i < kInteriorCount; ++i) {
    believe(kFirstInsideColumn + i, fit.interior[i] - start.interior[i], kInsideNear);
    believe(kFirstInsideColumn + i, fit.interior[i], kInsideRest);
  }
  for (std::size_t c = 0; c < kControlCount; ++c) {
    if (column_[c] < 0) continue;
    const double near = near_of(static_cast<int>(c));
    for (int axis = 0; axis < 2; ++axis) {
      const auto k = static_cast<std::size_t>(column_[c] + axis);
      believe(k, fit.offsets[c][axis] - start.offsets[c][axis], near * kUnitsPerEyeDistance);
      if (c >= kExpressionControls) believe(k, fit.offsets[c][axis], kControlRest * kUnitsPerEyeDistance);
    }
  }
  const cv::Mat1d& expression = expression_precision();
  for (std::size_t i = 0; i < 2 * kExpressionControls; ++i) {
    if (column_[i / 2] < 0) continue;
    const std::size_t k = static_cast<std::size_t>(column_[i / 2]) + i % 2;
    for (std::size_t j = 0; j < 2 * kExpressionControls; ++j) {
      if (column_[j / 2] < 0) continue;
      const std::size_t l = static_cast<std::size_t>(column_[j / 2]) + j % 2;
      const double p = expression(static_cast<int>(i), static_cast<int>(j)) /
                       (static_cast<double>(kUnitsPerEyeDistance) * kUnitsPerEyeDistance);
      if (k <= l) normal.at(k, l) += p;
      normal.right[k] -= p * fit.offsets[j / 2][static_cast<int>(j % 2)];
    }
  }
}

void PictureFit::add_picture(int level, const Fit& fit, Normal& normal) const {
  const PoseJacobian jacobian(fit.pose);
  const HeadVertices vertices = deformed(fit);
  const glm::dvec2 ex(jacobian.projection().matrix[0]), ey(jacobian.projection().matrix[1]);
  const double to_level = picture_.scale / (1 << level);
  std::array<glm::ivec3, kVertexCount> rounded;
  for (std::size_t v = 0; v < kVertexCount; ++v) rounded[v] = glm::ivec3(vertices[v]);
  const std::int32_t shade = interior_opacity(mouth_gap(rounded), gap_seen_);
  const auto& seen = pattern_luma_[level];
  Block block;
  for (const Patch& patch : patches_) {
    block.begin(kFirstControlColumn + 2 * patch.controls.size());
    const float* share = patch.shares.data();
    for (std::size_t k = patch.first; k < patch.end; ++k, share += patch.controls.size()) {
      const double value = shown(k, level, shade, fit);
      if (value < 0) continue;
      const glm::dvec3 p = points_[k].on(vertices);
      Sample s;
      if (!sample_with_slope(luma_[level], on_level(picture_.to_work(jacobian.projection()(p)), level), s))
        continue;
      const double r = value - static_cast<double>(s.value);
      normal.cost += huber(r);
      const double w = std::min(1.0, kHuber / (std::abs(r) + 1e-9)) / (kNoise * kNoise);
      float* row = block.row.data();
      for (const glm::dvec2& by : jacobian.at(p))
        *row++ = static_cast<float>(to_level * (s.dx * by.x + s.dy * by.y));
      const double ramp = static_cast<double>(mouth_ramp_[k]), covered = ramp < 0 ? 0 : shade / 256.0;
      for (const double light : light_at(k, static_cast<double>(seen[k])))
        *row++ = static_cast<float>(-light * (1 - covered));
      for (const double inside : inside_at(ramp)) *row++ = static_cast<float>(-inside * covered);
      const auto by_x = static_cast<float>(to_level * (s.dx * ex.x + s.dy * ex.y));
      const auto by_y = static_cast<float>(to_level * (s.dx * ey.x + s.dy * ey.y));
      for (std::size_t c = 0; c < patch.controls.size(); ++c) {
        *row++ = share[c] * by_x;
        *row++ = share[c] * by_y;
      }
      block.add(static_cast<float>(w), static_cast<float>(r));
    }
    // Columns rise within a patch, so that the upper triangle stays one.
    const auto column = [&](std::size_t i) {
      if (i < kFirstControlColumn) return i;
      const std::size_t c = i - kFirstControlColumn;
      return static_cast<std::size_t>(column_[patch.controls[c / 2]]) + c % 2;
    };
    for (std::size_t i = 0; i < block.n; ++i) {
      normal.right[column(i)] += static_cast<double>(block.right[i]);
      for (std::size_t j = i; j < block.n; ++j)
        normal.at(column(i), column(j)) += static_cast<double>(block.left[i * kMostColumns + j]);
    }
  }
}

bool PictureFit::step(int level, const Fit& start, Fit& fit) const {
  Normal normal(static_cast<std::size_t>(unknowns_));
  add_priors(start, fit, normal);
  add_picture(level, fit, normal);
  cv::Mat1d left(unknowns_, unknowns_, normal.left.data()), right(unknowns_, 1, normal.right.data()), x;
  cv::completeSymm(left);
  if (!cv::solve(left, right, x, cv::DECOMP_CHOLESKY)) return false;
  fit.pose = moved(fit.pose, {x(0), x(1), x(2), x(3), x(4), x(5)});
  for (int i = 0; i < kLightCount; ++i) fit.light[i] += x(kPoseCount + i);
  for (int i = 0; i < kInteriorCount; ++i) fit.interior[i] += x(kFirstInsideColumn + i);
  for (std::size_t c = 0; c < kControlCount; ++c) {
    if (column_[c] < 0) continue;
    for (int axis = 0; axis < 2; ++axis)
      fit.offsets[c][axis] = std::clamp(fit.offsets[c][axis] + x(column_[c] + axis), -kMaxOffset, kMaxOffset);
  }
  return true;
}

double PictureFit::difference(const Fit& fit) const {
  const HeadVertices vertices = deformed(fit);
  const PoseProjection projection(fit.pose);
  std::array<glm::ivec3, kVertexCount> rounded;
  for (std::size_t v = 0; v < kVertexCount; ++v) rounded[v] = glm::ivec3(vertices[v]);
  const std::int32_t shade = interior_opacity(mouth_gap(rounded), gap_seen_);
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const double value = shown(k, 0, shade, fit);
    Sample s;
    if (value < 0 || !sample_with_slope(luma_[0], picture_.to_work(projection(points_[k].on(vertices))), s))
      continue;
    sum += huber(value - static_cast<double>(s.value));
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

Fit PictureFit::refine(const Fit& start) const {
  Fit fit = start;
  for (int level = kLevels - 1; level >= 0; --level)
    for (int i = 0; i < kSteps[level]; ++i)
      if (!step(level, start, fit)) return start;
  return difference(fit) < difference(start) ? fit : start;
}

Fit PictureFit::refine_mouth(const Fit& start) const {
  const Fit fit = refine(start);
  const Feature& inner = feature(FeatureId::kMouthInner);
  const auto first = start.offsets.begin() + inner.first_control;
  const bool strayed = std::any_of(first, first + inner.control_count, [](const glm::dvec2& o) {
    return std::hypot(o.x, o.y) > kInnerLipsStray * kUnitsPerEyeDistance;
  });
  if (!strayed) return fit;
  Fit carried = start;
  std::fill_n(carried.offsets.begin() + inner.first_control, inner.control_count, glm::dvec2(0));
  carried = refine(carried);
  return difference(carried) < difference(fit) ? carried : fit;
}

PictureCost PictureFit::cost_at(const Fit& fit) const {
  Normal normal(static_cast<std::size_t>(unknowns_));
  add_picture(0, fit, normal);
  cv::Mat1d all(unknowns_, unknowns_, normal.left.data());
  cv::completeSymm(all);
  std::vector<int> place(static_cast<std::size_t>(unknowns_));
  for (int i = 0; i < kFitOffsets; ++i) place[i] = i;
  for (int c = 0; c < kControlCount; ++c)
    for (int axis = 0; axis < 2; ++axis)
      if (const int column = column_[c]; column >= 0) place[column + axis] = kFitOffsets + 2 * c + axis;
  cv::Mat1d own = cv::Mat1d::zeros(kFitNumbers, kFitNumbers);
  for (int i = 0; i < unknowns_; ++i)
    for (int j = 0; j < unknowns_; ++j) own(place[i], place[j]) = all(i, j);
  // add_picture() weighs by the noise and counts points, each of which stands for so many samples.
  const double samples = kPointSpacing * kPointSpacing / (picture_.scale * picture_.scale);
  return cost_of(fit, 0, normal.cost * samples, cv::Mat1d(own * samples * kNoise * kNoise));
}

}  // namespace fbs
