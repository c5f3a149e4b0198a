#include "training/belief_training.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "common/ibug.h"
#include "training/augmentation.h"
#include "training/cascade_training.h"
#include "training/in_parallel.h"

namespace fbs {
namespace {

/// As the last stage looks. {64, 2, 5} and a ridge of 20 believe twice as often what is wrong.
constexpr Look kBeliefLook = {96, 1.5F, 4};
constexpr float kScoreRidge = 2;

constexpr int kNear = 6, kOff = 3, kElsewhere = 5;  // places for each picture

/// A place without regard to where the face is; rarely it is found all the same.
PatchSample elsewhere(const FacePicture& face, std::mt19937& random) {
  FacePicture aside = face;
  const auto any = [&random](float from, float to) {
    return std::uniform_real_distribution<float>(from, to)(random);
  };
  const float size = eye_distance(face.landmarks) * std::exp(any(-1.5F, 0.9F));
  const glm::vec2 place(any(0, static_cast<float>(face.luma.cols)),
                        any(0, static_cast<float>(face.luma.rows)));
  // A shape of this size there is what the place is brought to the patch's middle by.
  const float turn = size / eye_distance(face.landmarks);
  const glm::vec2 middle = mean_of(face.landmarks);
  aside.landmarks =
      PlaneSimilarity{turn, {place.x - turn * middle.x, place.y - turn * middle.y}}(face.landmarks);
  PatchSample sample = augmented(aside, {}, random);
  // The truth goes where the face has gone.
  const PlaneSimilarity moved = PlaneSimilarity::between(aside.landmarks, sample.truth);
  sample.truth = moved(face.landmarks);
  return sample;
}

/// How many are believed, and how many of those are right, at places that the score was not fitted to.
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
                    std::mt19937& random) {
  constexpr PlaceNoise kFarOff = {0.4F, 0.4F};
  std::vector<PatchSample> samples;
  for (const FacePicture& face : faces) {
    for (int i = 0; i < kNear; ++i) samples.push_back(augmented(face, {}, random));
    for (int i = 0; i < kOff; ++i) samples.push_back(augmented(face, kFarOff, random));
    for (int i = 0; i < kElsewhere; ++i) samples.push_back(elsewhere(face, random));
  }
  Outcomes out;
  out.descriptors.resize(static_cast<Eigen::Index>(samples.size()), kDescriptorSize);
  out.spreads.resize(samples.size());
  out.error.resize(samples.size());
  in_parallel(samples.size(), [&](std::size_t n) {
    const auto i = static_cast<Eigen::Index>(n);
    const auto end = search.descend(samples[n].patch);
    describe(samples[n].patch, end.shape, search.table().mean, kBeliefLook,
             {out.descriptors.row(i).data(), kDescriptorSize});
    out.spreads[n] = end.spread;
    out.error[n] =
        std::max(error_of(end.shape, samples[n].truth, ibug::kEyesFirst, ibug::kEyesEnd),
                 error_of(end.shape, samples[n].truth, ibug::kOuterLipsFirst, ibug::kInnerLipsFirst));
  });
  return out;
}

BeliefTable train_belief(const std::vector<const Outcomes*>& outcomes) {
  Eigen::Index rows = 0;
  for (const Outcomes* o : outcomes) rows += o->descriptors.rows();
  RowMatrix descriptors(rows, kDescriptorSize), right(rows, 1);
  RowMatrix evidence(rows, 2);
  Eigen::Index row = 0;
  for (const Outcomes* o : outcomes) {
    descriptors.middleRows(row, o->descriptors.rows()) = o->descriptors;
    for (std::size_t i = 0; i < o->error.size(); ++i, ++row) {
      right(row) = o->error[i] < kWrongFrom ? 1 : 0;
      evidence(row, 1) = o->spreads[i];
    }
  }
  // Scores of rows that the regression has not seen: the odds are fitted to those. Rows of one picture are
  // neighbours, so halves hold different people but for one.
  const Eigen::Index half = rows / 2;
  const auto score = [&](Eigen::Index fitted, Eigen::Index scored) {
    const LinearMap map =
        fit_ridge(descriptors.middleRows(fitted, half), right.middleRows(fitted, half), kScoreRidge);
    evidence.middleRows(scored, half).col(0) =
        (descriptors.middleRows(scored, half) * map.weights).array() + map.offset(0);
  };
  score(0, rows - half);
  score(rows - half, 0);
  const LinearMap odds = fit_logistic(evidence, right.col(0));
  report(evidence, right, odds);
  const LinearMap all = fit_ridge(descriptors, right, kScoreRidge);
  BeliefTable out;
  out.look = kBeliefLook;
  out.score = quantised(all.weights * odds.weights(0));
  out.spread = odds.weights(1);
  out.offset = odds.offset(0) + odds.weights(0) * all.offset(0);
  return out;
}

}  // namespace fbs
