#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "decoder/draw/renderer.h"
#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"
#include "encoder/retarget/face_stream.h"
#include "encoder/retarget/motion_record.h"
#include "encoder/retarget/retarget.h"
#include "encoder/retarget/wire_frame_fit.h"
#include "tests/figures/canvas.h"
#include "tests/figures/edited_state.h"
#include "tests/figures/figures.h"
#include "tests/figures/sheet.h"
#include "tests/unit/split_head.h"

namespace fbs::figures {
namespace {

constexpr int kPanelWidth = 240;          // pixels
constexpr double kYaw = 24, kPitch = 12;  // degrees; of the free views
constexpr double kAspect = 0.74;          // of a panel
const cv::Scalar kPaper(255, 255, 255), kLine(120, 85, 40);

/// The part of the pictures of a face that is shown.
class Stage {
 public:
  /// @param states  of the face, whose heads lie in the part
  Stage(const VideoFormat& format, const Geometry& geometry, const std::vector<State>& states)
      : format_(format), geometry_(geometry) {
    std::vector<glm::dvec2> all;
    for (const State& s : states)
      for (const glm::dvec3& v : head(s)) all.emplace_back(v);
    part_ = part_with(all);
    const double width = std::max(part_.width, part_.height * kAspect), height = width / kAspect;
    part_ = {part_.x + part_.width / 2 - width / 2, part_.y + part_.height / 2 - height / 2, width, height};
  }

  [[nodiscard]] Result<Panel> drawn(const Scene& scene, const State& state, std::string caption) const {
    Picture out;
    if (auto drawn = Renderer().render(scene, state, out); !drawn) return fail(drawn.error());
    return panel(out, std::move(caption));
  }
  [[nodiscard]] Panel panel(const Picture& picture, std::string caption) const {
    return {Canvas(picture, format_, part_, kPanelWidth).image(), std::move(caption)};
  }
  [[nodiscard]] Panel wire_frame(const State& state, std::string caption) const {
    Canvas canvas(part_, kPanelWidth, kPaper);
    canvas.wire_frame(geometry_.wire_frame(), head(state), kLine);
    return {canvas.image(), std::move(caption)};
  }

 private:
  [[nodiscard]] std::vector<glm::dvec3> head(const State& state) const {
    return screen_vertices(project_vertices(geometry_, state), state);
  }

  const VideoFormat& format_;
  const Geometry& geometry_;
  cv::Rect2d part_;
};

/// A face and its wire-frame with the motion of another, as `fbs retarget --wire-frame` makes it.
struct Retargeted {
  VideoFormat format;
  MotionRecord motion;
  std::vector<Picture> pictures;  ///< those asked for
};

/// @param numbers  of the pictures
Result<Retargeted> retargeted(const std::vector<std::uint8_t>& motion, std::span<const std::uint8_t> face,
                              const std::vector<int>& numbers) {
  const auto moves = read_motion_record(motion);
  if (!moves) return fail(moves.error());
  auto shown = read_face_stream(face).and_then(
      [](FaceStream own) { return on_wire_frame(std::move(own), split_head()); });
  if (!shown) return fail(shown.error());
  const auto stream = retarget(*moves, *shown);
  if (!stream) return fail(stream.error());
  auto record = read_motion_record(*stream);
  if (!record) return fail(record.error());
  auto pictures = decode(*stream, numbers);
  if (!pictures) return fail(pictures.error());
  return Retargeted{shown->setup.format, std::move(*record), std::move(*pictures)};
}

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

Result<SynthesisFigure> synthesis_figure(const Footage& footage, const Paths& paths,
                                         std::span<const std::uint8_t> other) {
  const Followed& paper = paths.paper;
  const std::vector<int> numbers = mouth_pictures(footage, paths);
  std::vector<State> states;  // of the pictures of Figure 5
  for (const int i : numbers) states.push_back(paper.states[static_cast<std::size_t>(i)]);
  const auto source = [&](std::size_t k) { return footage.pictures[static_cast<std::size_t>(numbers[k])]; };
  const auto theirs = retargeted(paper.stream, other, {numbers[0], numbers[2]});
  if (!theirs) return fail(theirs.error());
  const Geometry& their_head = theirs->motion.geometries.front();
  const auto their_state = [&](std::size_t k) {
    return theirs->motion.pictures[static_cast<std::size_t>(numbers[k])].state;
  };
  const State left = turned(states[1], kYaw, 0), right = turned(states[3], -kYaw, kPitch);

  const Stage stage(footage.format, paper.geometry(),
                    {states[0], states[1], states[2], states[3], left, right});
  const Stage their_stage(theirs->format, their_head, {their_state(0), their_state(2)});
  Row views, motion, wires, pattern;
  views.add(stage.drawn(paper.scene, states[1], "Fig. 5 (d)"));
  views.add(stage.drawn(paper.scene, left, "(a) Fig. 5 (d) turned"));
  views.add(stage.drawn(paper.scene, states[3], "Fig. 5 (h)"));
  views.add(stage.drawn(paper.scene, right, "(b) Fig. 5 (h) turned"));
  const char* const sources[] = {"Fig. 5 (a)", "Fig. 5 (e)"};
  const char* const others[] = {"(c) other model, Fig. 5 (a)", "(d) other model, Fig. 5 (e)"};
  const std::string vertices = " of " + std::to_string(their_head.positions.size()) + " vertices";
  for (std::size_t k = 0; k < 2; ++k) {
    motion.add(stage.panel(source(2 * k), sources[k]));
    motion.add(their_stage.panel(theirs->pictures[k], others[k]));
    wires.add(stage.wire_frame(states[2 * k], "wire-frame"));
    wires.add(their_stage.wire_frame(their_state(2 * k), "other wire-frame" + vertices));
  }
  const Scene repainted = with_pattern(paper.scene, source(3), states[3]);
  pattern.add(stage.panel(source(3), "another pattern"));
  pattern.add(stage.drawn(repainted, states[0], "(e) on Fig. 5 (b)"));
  pattern.add(stage.drawn(repainted, states[1], "(f) on Fig. 5 (d)"));
  pattern.add(stage.drawn(repainted, left, "(g) on (a)"));
  for (const Row* row : {&views, &motion, &wires, &pattern})
    if (row->error()) return fail(*row->error());
  const auto gap = [](const Geometry& geometry, const State& state) {
    return static_cast<double>(mouth_gap(geometry, state)) / kUnitsPerEyeDistance;
  };
  return SynthesisFigure{sheet({views.panels, motion.panels, wires.panels, pattern.panels}),
                         {gap(paper.geometry(), states[0]), gap(paper.geometry(), states[2])},
                         {gap(their_head, their_state(0)), gap(their_head, their_state(2))}};
}

}  // namespace fbs::figures
