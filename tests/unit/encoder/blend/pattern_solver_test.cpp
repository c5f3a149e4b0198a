#include "encoder/blend/pattern_solver.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/blend/blended_scene.h"

namespace fbs {
namespace {

using PicturePlane = Plane Picture::*;
/// A plane of each pattern.
using Planes = std::vector<ReducedPlane>;

SolvedPlanes alone(const ReducedPlane& plane) {
  return SolvedPlanes({&plane, 1});
}

Planes planes_of(const Scene& scene, PicturePlane plane, int reduction = 0) {
  Planes out;
  for (const Pattern& p : scene.patterns) out.push_back(reduce(p.picture.*plane, reduction));
  return out;
}

Plane rounded(const ReducedPlane& plane) {
  Plane out(plane.width, plane.height);
  for (std::size_t i = 0; i < out.samples.size(); ++i)
    out.samples[i] = static_cast<std::uint8_t>(std::clamp(std::lround(plane.samples[i]), 0L, 255L));
  return out;
}

double mean_square(const ReducedPlane& a, const ReducedPlane& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) sum += std::pow(a.samples[i] - b.samples[i], 2);
  return sum / static_cast<double>(a.samples.size());
}

/// The last numbers below `all`.
std::vector<std::size_t> last(std::size_t count, std::size_t all) {
  std::vector<std::size_t> out;
  for (std::size_t k = all - count; k < all; ++k) out.push_back(k);
  return out;
}

void add_to(PatternSolver& solver, std::size_t number, const State& state,
            std::span<const std::size_t> available, glm::ivec2 size) {
  solver.resize(number + 1);
  solver.set_picture(number, state, available, size);
}

void add_change(const ReducedPlane& change, ReducedPlane& plane) {
  for (std::size_t i = 0; i < plane.samples.size(); ++i) plane.samples[i] += change.samples[i];
}

/// Pictures of a scene that is drawn by the renderer, and the problem to find its patterns from them.
struct Problem {
  BlendedScene s;
  PicturePlane plane;
  PatternSolver solver;
  std::vector<State> states;
  std::vector<ReducedPlane> targets;

  explicit Problem(std::size_t patterns, PicturePlane of = &Picture::y)
      : s(patterns), plane(of), solver(s.blend(), reduction(), {component()}) {}

  [[nodiscard]] bool is_luma() const { return plane == &Picture::y; }
  [[nodiscard]] std::size_t component() const { return is_luma() ? 0 : plane == &Picture::u ? 1 : 2; }
  [[nodiscard]] int reduction() const { return is_luma() ? 0 : 1; }  // chroma planes have half the size

  void add(const State& state) {
    const VideoFormat& f = s.scene.setup.format;
    add_to(solver, states.size(), state, s.all(), {f.width, f.height});
    states.push_back(state);
    targets.push_back(reduce(rendered(s.scene, state).*plane, 0));
  }
  /// Each pattern alone, and blends of all.
  void add_pictures() {
    for (const Pattern& p : s.scene.patterns) add(with_mode(p.seen, BlendMode::kStillBefore));
    for (unsigned seed = 0; seed < 6; ++seed) {
      State state = SeenScene::rest();
      StateMaker maker(seed);
      maker.pose(state), maker.expression(state);
      state.picture = static_cast<int>(4 * seed);
      add(with_mode(state, seed % 2 == 0 ? BlendMode::kByState : nearest(static_cast<int>(seed) / 2)));
    }
  }
  [[nodiscard]] Planes truth() const { return planes_of(s.scene, plane); }
  [[nodiscard]] Planes solved(const Planes& start, std::size_t count, const SolverSettings& settings,
                              int threads = 1) const {
    PatternPlanes sources;
    for (const ReducedPlane& p : start) sources.push_back(alone(p));
    Workers workers(threads);
    const auto change = solver.solve([&](std::size_t k) -> Result<SolvedPlanes> { return alone(targets[k]); },
                                     sources, last(count, start.size()), settings, workers);
    Planes out = start;
    for (std::size_t k = 0; k < count; ++k) add_change((*change)[k].plane(0), out[out.size() - count + k]);
    return out;
  }
  /// Gives the patterns of a scene these luma planes.
  static void show(Scene& scene, const Planes& luma) {
    for (std::size_t k = 0; k < luma.size(); ++k) {
      Picture picture = scene.patterns[k].picture;
      picture.y = rounded(luma[k]);
      scene.patterns.replace(k, make_pattern(std::move(picture), scene.patterns[k].seen, scene.geometry));
    }
  }
  /// Squared luma error of the pictures as drawn by the renderer.
  [[nodiscard]] double loss(const Planes& planes) const {
    Scene scene = s.scene;
    show(scene, planes);
    double sum = 0;
    for (std::size_t t = 0; t < states.size(); ++t)
      sum += mean_square(reduce(rendered(scene, states[t]).y, 0), targets[t]);
    return sum;
  }
};

/// Other paint, in part.
Planes changed(Planes planes) {
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const ReducedPlane other =
        reduce(wave_plane(planes[k].width, planes[k].height, 300 + static_cast<unsigned>(k)), 0);
    for (std::size_t i = 0; i < planes[k].samples.size(); ++i)
      planes[k].samples[i] += 0.5F * (other.samples[i] - 128);
  }
  return planes;
}

TEST(PatternSolver, FindsThePatternsThatPicturesAreDrawnFrom) {
  Problem p(3);
  p.add_pictures();
  const Planes truth = p.truth(), start = changed(truth), found = p.solved(start, 3, {30, 1e-5});
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GT(mean_square(start[k], truth[k]), 100);
    EXPECT_LT(mean_square(found[k], truth[k]), 1) << k;
  }
}

TEST(PatternSolver, EachIterationBringsThePicturesNearer) {
  Problem p(3);
  p.add_pictures();
  const Planes start = changed(p.truth());
  double before = p.loss(start);
  const double begin = before;
  for (int iterations = 1; iterations <= 5; ++iterations) {
    const double loss = p.loss(p.solved(start, 3, {iterations, 1e-5}));
    EXPECT_LT(loss, before) << iterations;
    before = loss;
  }
  EXPECT_LT(before, 0.1 * begin);
}

TEST(PatternSolver, PullHoldsPatternsToTheirSources) {
  Problem p(3);
  p.add_pictures();
  const Planes start = changed(p.truth());
  double before = 1e9;
  for (const double pull : {1e-5, 0.2, 5.0, 1e4}) {
    double moved = 0;
    const Planes found = p.solved(start, 3, {10, pull});
    for (std::size_t k = 0; k < 3; ++k) moved += mean_square(found[k], start[k]);
    EXPECT_LT(moved, before) << pull;
    before = moved;
  }
  EXPECT_LT(before, 0.01);
}

TEST(PatternSolver, FixedPatternsStayAndTheLastAreSolvedFor) {
  Problem p(3);
  p.add_pictures();
  const Planes truth = p.truth();
  Planes start = changed(truth);
  start[0] = truth[0], start[1] = truth[1];
  const Planes found = p.solved(start, 1, {30, 1e-5});
  EXPECT_EQ(found[0].samples, truth[0].samples);
  EXPECT_EQ(found[1].samples, truth[1].samples);
  EXPECT_LT(mean_square(found[2], truth[2]), 1);
}

TEST(PatternSolver, WorkersFindWhatOneFinds) {
  Problem p(4);
  for (int k = 0; k < 3; ++k) p.add_pictures();
  const Planes start = changed(p.truth()), alone = p.solved(start, 3, {4, 0.2});
  for (const int threads : {2, 3, 7}) {
    const Planes found = p.solved(start, 3, {4, 0.2}, threads);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(found[k].samples, alone[k].samples) << threads << ' ' << k;
  }
}

TEST(PatternSolver, PatternsThatAreNotAvailableStay) {
  Problem p(3);
  const State state = with_mode(SeenScene::rest(), BlendMode::kByState);
  const std::vector<std::size_t> some = {0, 2};
  add_to(p.solver, 0, state, some, {BlendedScene::kWidth, BlendedScene::kHeight});
  p.targets.push_back(reduce(wave_plane(BlendedScene::kWidth, BlendedScene::kHeight, 50), 0));
  const Planes truth = p.truth(), found = p.solved(truth, 3, {4, 0.2});
  EXPECT_GT(mean_square(found[0], truth[0]), 0.1);
  EXPECT_EQ(found[1].samples, truth[1].samples);
  EXPECT_GT(mean_square(found[2], truth[2]), 0.1);
}

double product(const Planes& a, const Planes& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].samples.size(); ++i)
      sum += double{a[k].samples[i]} * double{b[k].samples[i]};
  return sum;
}

// From black patterns the first step is along A^T y, y being the picture: <A x, y> / <x, A^T y> is then the
// same for any patterns x.
TEST(PatternSolver, FirstStepIsAlongTheTransposedDrawing) {
  Problem p(3);
  State state = SeenScene::rest();
  StateMaker maker(9);
  maker.pose(state), maker.expression(state);
  state.picture = 7;
  p.add(with_mode(state, BlendMode::kByState));
  Planes black = p.truth();
  for (ReducedPlane& plane : black) std::fill(plane.samples.begin(), plane.samples.end(), 0.0F);
  const Planes step = p.solved(black, 3, {1, 0});

  std::vector<double> ratios;
  for (std::size_t k = 0; k < 3; ++k) {
    for (int piece = 0; piece < 4; ++piece) {
      Planes x = black;
      for (int y = 60 * piece; y < 60 * piece + 60; ++y)
        std::fill_n(x[k].row(y), BlendedScene::kWidth, 200.0F);
      Scene scene = p.s.scene;
      Problem::show(scene, x);
      const Planes drawn = {reduce(rendered(scene, p.states[0]).y, 0)};
      ratios.push_back(product(drawn, p.targets) / product(x, step));
    }
  }
  for (const double r : ratios) EXPECT_NEAR(r / ratios[0], 1, 0.08);  // weights at nodes are sixteenths
}

State with_light_and_mouth() {
  State state = SeenScene::rest();
  state.light = {20 * 16, 5 * 16, 8 * 16, 0, 0, 0, 0};
  for (const int c : {4, 5, 6, 7}) state.control[feature(FeatureId::kMouthInner).first_control + c].y += 130;
  state.interior.fill(15 * 16);
  return with_mode(state, BlendMode::kByState);
}

/// Share of the samples that change by three levels or more.
double share_changed(const Planes& a, const Planes& b) {
  double changed = 0, all = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].samples.size(); ++i, ++all)
      changed += std::abs(double{a[k].samples[i]} - double{b[k].samples[i]}) < 3 ? 0 : 1;
  return changed / all;
}

// Patterns that draw the pictures exactly are the solution, but for the border of the mouth, where the
// renderer's colours fade.
TEST(PatternSolver, LightAndMouthInteriorAreNotTakenForPatterns) {
  for (const PicturePlane plane : {&Picture::y, &Picture::u, &Picture::v}) {
    Problem p(2, plane);
    p.add(with_light_and_mouth());
    const Planes truth = p.truth();
    EXPECT_LT(share_changed(p.solved(truth, 2, {4, 0.2}), truth), 0.01) << (p.is_luma() ? "luma" : "chroma");
  }
}

TEST(PatternSolver, PlanesSolvedTogetherAreThoseSolvedAlone) {
  const SolverSettings settings{4, 0.2};
  Problem u(3, &Picture::u), v(3, &Picture::v);
  u.add_pictures(), v.add_pictures();
  PatternSolver both(u.s.blend(), 1, {1, 2});
  std::vector<SolvedPlanes> targets;
  for (std::size_t t = 0; t < u.states.size(); ++t) {
    add_to(both, t, u.states[t], u.s.all(), {BlendedScene::kWidth, BlendedScene::kHeight});
    targets.emplace_back(std::array{u.targets[t], v.targets[t]});
  }
  const Planes start_u = changed(u.truth()), start_v = changed(v.truth());
  PatternPlanes sources;
  for (std::size_t k = 0; k < 3; ++k) sources.emplace_back(std::array{start_u[k], start_v[k]});
  Workers workers;
  const auto together = both.solve([&](std::size_t k) -> Result<SolvedPlanes> { return targets[k]; }, sources,
                                   last(3, 3), settings, workers);
  ASSERT_TRUE(together);
  const Planes u_alone = u.solved(start_u, 3, settings), v_alone = v.solved(start_v, 3, settings);
  for (std::size_t k = 0; k < 3; ++k) {
    ReducedPlane u_together = start_u[k], v_together = start_v[k];
    add_change((*together)[k].plane(0), u_together);
    add_change((*together)[k].plane(1), v_together);
    EXPECT_EQ(u_together.samples, u_alone[k].samples) << k;
    EXPECT_EQ(v_together.samples, v_alone[k].samples) << k;
  }
}

}  // namespace
}  // namespace fbs
