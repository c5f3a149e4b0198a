#include "training/belief_training.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "common/ibug.h"
#include "training/augmentation.h"
#include "training/cascade_training.h"
#include "training/in_parallel.h"
#include "training/place_training.h"

namespace fbs {
namespace {

/// The last stage's resolution, and the first's. The latter, and the logarithm of the spread, each reduce the
/// strangers' logarithmic loss by 3 %; a third resolution gains nothing, and a ridge of 20 believes twice as
/// often what is wrong.
constexpr std::array<Look, kBeliefViews> kBeliefLooks = {{{96, 1.5F, 4}, {48, 2, 5}}};
constexpr float kScoreRidge = 2;

constexpr int kNear = 6, kOff = 3, kElsewhere = 3, kProposed = 5;  // places for each picture

/// Reports how many are believed, and how many of those are right, at places that the score was not fitted
/// to.
void report(const RowMatrix& evidence, const RowMatrix& right, const LinearMap& odds) {
  const Eigen::VectorXf log_odds = (evidence * odds.weights).array() + odds.offset(0);
  for (const float belief : {0.5F, 0.9F}) {
    const Eigen::ArrayXf believed = (log_odds.array() > std::log(belief / (1 - belief))).cast<float>();
    std::cout << "believed at " << belief << ": " << believed.sum() << " of " << right.size() << ", "
              << (believed * right.array()).sum() << " of them right, "
              << ((1 - believed) * right.array()).sum() << " right ones are not believed\n";
  }
}

}  // namespace

float error_of(const Shape& found, const Shape& truth, int first, int end) {
  float sum = 0;
  for (int k = first; k < end; ++k) {
    const glm::vec2 d = found[static_cast<std::size_t>(k)] - truth[static_cast<std::size_t>(k)];
    sum += std::hypot(d.x, d.y);
  }
  return sum / static_cast<float>(end - first) / std::max(eye_distance(truth), 1e-3F);
}

Outcomes try_search(const LandmarkSearch& search, const std::vector<FacePicture>& faces,
                    const std::vector<cv::Mat1b>& textures, std::mt19937& random) {
  constexpr PlaceNoise kFarOff = {0.4F, 0.4F};
  const PlaceSearch places(search.table());
  std::vector<PatchSample> samples;
  for (const FacePicture& face : faces) {
    const FacePlace place = place_of(face.landmarks);
    for (int i = 0; i < kNear; ++i) samples.push_back(augmented(face, place, {}, random));
    for (int i = 0; i < kOff; ++i) samples.push_back(augmented(face, place, kFarOff, random));
    for (int i = 0; i < kElsewhere; ++i)
      samples.push_back(augmented(face, any_place(face, random), {}, random));
    // The places that the search will examine, right or wrong.
    for (const FacePlace& proposed : likeliest(places, face.luma, kProposed))
      samples.push_back(augmented(face, proposed, {0.02F, 0.02F}, random));
  }
  constexpr Shape kNowhere{};
  for (const cv::Mat1b& texture : textures)
    for (const FacePlace& proposed : likeliest(places, texture, kProposed))
      samples.push_back({FacePatch(texture, proposed).luma(), kNowhere});
  Outcomes out;
  out.descriptors.resize(static_cast<Eigen::Index>(samples.size()), kBeliefViews * kDescriptorSize);
  out.spreads.resize(samples.size());
  out.places.resize(samples.size());
  out.error.resize(samples.size());
  in_parallel(samples.size(), [&](std::size_t n) {
    const auto i = static_cast<Eigen::Index>(n);
    const auto end = search.descend(samples[n].patch);
    float* next = out.descriptors.row(i).data();
    for (const Look& look : kBeliefLooks) {
      UprightView(samples[n].patch, end.shape, search.table().mean, look)
          .describe(end.shape, {next, kDescriptorSize});
      next += kDescriptorSize;
    }
    out.spreads[n] = end.spread;
    out.places[n] = PlaceSearch::score(samples[n].patch, search.table());
    out.error[n] =
        std::max(error_of(end.shape, samples[n].truth, ibug::kEyesFirst, ibug::kEyesEnd),
                 error_of(end.shape, samples[n].truth, ibug::kOuterLipsFirst, ibug::kInnerLipsFirst));
  });
  return out;
}

BeliefTable train_belief(const std::vector<const Outcomes*>& outcomes) {
  Eigen::Index rows = 0;
  for (const Outcomes* o : outcomes) rows += o->descriptors.rows();
  RowMatrix descriptors(rows, outcomes.front()->descriptors.cols()), right(rows, 1);
  RowMatrix evidence(rows, 3);
  Eigen::Index row = 0;
  for (const Outcomes* o : outcomes) {
    descriptors.middleRows(row, o->descriptors.rows()) = o->descriptors;
    for (std::size_t i = 0; i < o->error.size(); ++i, ++row) {
      right(row) = o->error[i] < kWrongFrom ? 1 : 0;
      evidence(row, 1) = std::log(o->spreads[i] + kLeastSpread);
      evidence(row, 2) = o->places[i];
    }
  }
  // Scores of rows that the regression has not seen, to which the odds are fitted. Rows of one picture are
  // neighbours, so the halves show different people, except for one.
  const auto score = [&](Eigen::Index first, Eigen::Index count, Eigen::Index fitted,
                         Eigen::Index fitted_count) {
    const LinearMap map = fit_ridge(descriptors.middleRows(fitted, fitted_count),
                                    right.middleRows(fitted, fitted_count), kScoreRidge);
    evidence.middleRows(first, count).col(0) =
        (descriptors.middleRows(first, count) * map.weights).array() + map.offset(0);
  };
  const Eigen::Index half = rows / 2;
  score(0, half, half, rows - half);
  score(half, rows - half, 0, half);
  const LinearMap odds = fit_logistic(evidence, right.col(0));
  report(evidence, right, odds);
  const LinearMap all = fit_ridge(descriptors, right, kScoreRidge);
  BeliefTable out;
  for (std::size_t i = 0; i < kBeliefViews; ++i) {
    const auto first = static_cast<Eigen::Index>(i * kDescriptorSize);
    out.views[i] = {kBeliefLooks[i],
                    quantised(all.weights.middleRows(first, kDescriptorSize) * odds.weights(0))};
  }
  out.spread = odds.weights(1);
  out.place = odds.weights(2);
  out.offset = odds.offset(0) + odds.weights(0) * all.offset(0);
  return out;
}

}  // namespace fbs
