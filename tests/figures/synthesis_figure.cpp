#include <algorithm>
#include <optional>
#include <utility>

#include "decoder/renderer.h"
#include "tests/figures/canvas.h"
#include "tests/figures/edited_state.h"
#include "tests/figures/figures.h"
#include "tests/figures/sheet.h"

namespace fbs::figures {
namespace {

constexpr int kPanelWidth = 240;          // pixels
constexpr double kYaw = 24, kPitch = 12;  // degrees; of the free views
constexpr double kAspect = 0.74;          // of a panel
const cv::Scalar kPaper(255, 255, 255), kLine(120, 85, 40);

/// A scene and the part of its pictures that is shown.
class Stage {
 public:
  /// @param states  whose heads lie in the part
  Stage(const VideoFormat& format, const Scene& scene, const std::vector<State>& states)
      : format_(format), scene_(scene) {
    std::vector<glm::dvec2> all;
    for (const State& s : states)
      for (const glm::dvec3& v : head(s)) all.emplace_back(v);
    part_ = part_with(all);
    const double width = std::max(part_.width, part_.height * kAspect), height = width / kAspect;
    part_ = {part_.x + part_.width / 2 - width / 2, part_.y + part_.height / 2 - height / 2, width, height};
  }

  [[nodiscard]] Result<Panel> picture(const State& state, std::string caption) const {
    Picture out;
    if (auto drawn = Renderer().render(scene_, state, out); !drawn) return fail(drawn.error());
    return panel(out, std::move(caption));
  }
  [[nodiscard]] Panel panel(const Picture& picture, std::string caption) const {
    return {Canvas(picture, format_, part_, kPanelWidth).image(), std::move(caption)};
  }
  [[nodiscard]] Panel wire_frame(const State& state, std::string caption) const {
    Canvas canvas(part_, kPanelWidth, kPaper);
    canvas.wire_frame(head(state), kLine);
    return {canvas.image(), std::move(caption)};
  }

 private:
  [[nodiscard]] std::vector<glm::dvec3> head(const State& state) const {
    return screen_vertices(scene_.geometry->project_vertices(state), state);
  }

  const VideoFormat& format_;
  const Scene& scene_;
  cv::Rect2d part_;
};

/// The scene with one of its footage's pictures as its only pattern.
Scene with_pattern(const Scene& scene, const Picture& picture, const State& seen) {
  Scene out = scene;
  out.patterns.clear();
  out.patterns.push_back(make_pattern(picture, seen, out.geometry));
  return out;
}

/// Panels in a row, until one fails.
class Row {
 public:
  void add(Result<Panel> panel) {
    if (!panel)
      error_ = panel.error();
    else
      panels.push_back(std::move(*panel));
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  std::vector<Panel> panels;

 private:
  std::optional<Error> error_;
};

}  // namespace

Result<SynthesisFigure> synthesis_figure(const Footage& footage, const Paths& paths, const OtherFace& other) {
  const Followed& paper = paths.paper;
  std::vector<State> states;  // of the pictures of Figure 5
  std::vector<std::size_t> numbers;
  for (const int i : mouth_pictures(footage, paths)) {
    numbers.push_back(static_cast<std::size_t>(i));
    states.push_back(paper.states[numbers.back()]);
  }
  const Actor from{paper.geometry(), paper.states.front()}, to{other.scene.geometry->geometry(), other.rest};
  const auto transfer = [&](std::size_t k) { return transferred(states[k], from, to); };
  const State left = turned(states[1], kYaw, 0), right = turned(states[3], -kYaw, kPitch);

  const Stage stage(footage.format, paper.scene, {states[0], states[1], states[2], states[3], left, right});
  const Stage theirs(other.format, other.scene, {transfer(0), transfer(2)});
  Row views, motion, wires, pattern;
  views.add(stage.picture(states[1], "Fig. 5 (d)"));
  views.add(stage.picture(left, "(a) Fig. 5 (d) turned"));
  views.add(stage.picture(states[3], "Fig. 5 (h)"));
  views.add(stage.picture(right, "(b) Fig. 5 (h) turned"));
  const char* const sources[] = {"Fig. 5 (a)", "Fig. 5 (e)"};
  const char* const others[] = {"(c) other model, Fig. 5 (a)", "(d) other model, Fig. 5 (e)"};
  for (std::size_t k = 0; k < 2; ++k) {
    motion.add(stage.panel(footage.pictures[numbers[2 * k]], sources[k]));
    motion.add(theirs.picture(transfer(2 * k), others[k]));
    wires.add(stage.wire_frame(states[2 * k], "wire-frame"));
    wires.add(theirs.wire_frame(transfer(2 * k), "other wire-frame"));
  }
  const Scene repainted = with_pattern(paper.scene, footage.pictures[numbers[3]], states[3]);
  const Stage again(footage.format, repainted, {states[0], states[1], states[2], states[3], left, right});
  pattern.add(stage.panel(footage.pictures[numbers[3]], "another pattern"));
  pattern.add(again.picture(states[0], "(e) on Fig. 5 (b)"));
  pattern.add(again.picture(states[1], "(f) on Fig. 5 (d)"));
  pattern.add(again.picture(left, "(g) on (a)"));
  for (const Row* row : {&views, &motion, &wires, &pattern})
    if (row->error()) return fail(*row->error());
  return SynthesisFigure{sheet({views.panels, motion.panels, wires.panels, pattern.panels}),
                         {mouth_gap(states[0], from), mouth_gap(states[2], from)},
                         {mouth_gap(transfer(0), to), mouth_gap(transfer(2), to)}};
}

}  // namespace fbs::figures
