#include "decoder/draw/renderer.h"
#include "tests/figures/canvas.h"
#include "tests/figures/edited_state.h"
#include "tests/figures/figures.h"
#include "tests/figures/sheet.h"

namespace fbs::figures {
namespace {

constexpr int kPanelWidth = 200;                                       // pixels
constexpr double kYaw = 22, kPitch = 14, kBrows = 0.14, kMouth = 0.3;  // degrees, eye distances
const cv::Scalar kPaper(255, 255, 255), kLine(120, 85, 40);

struct Edited {
  const char* caption;
  State state;
};

std::vector<Edited> edited(const State& rest) {
  const State aside = turned(rest, kYaw, 0);
  return {{"neutral", rest},
          {"turned", aside},
          {"nodding", turned(rest, 0, kPitch)},
          {"brows raised", with_brows_raised(rest, kBrows)},
          {"turned, brows raised", with_brows_raised(aside, kBrows)},
          {"and the mouth open", with_mouth_open(with_brows_raised(aside, kBrows), kMouth)}};
}

}  // namespace

Result<cv::Mat3b> animation_figure(const Footage& footage, const Followed& paper) {
  const std::vector<Edited> states = edited(paper.states.front());
  std::vector<glm::dvec2> all;
  for (const Edited& e : states)
    for (const glm::dvec3& v : paper.head(e.state)) all.emplace_back(v);
  const cv::Rect2d part = part_with(all);
  std::vector<Panel> wire_frames, patterned;
  Renderer renderer;
  for (std::size_t k = 0; k < states.size(); ++k) {
    Canvas wires(part, kPanelWidth, kPaper);
    wires.wire_frame(generic_head(), paper.head(states[k].state), kLine);
    Picture picture;
    if (auto drawn = renderer.render(paper.scene, states[k].state, picture); !drawn)
      return fail(drawn.error());
    wire_frames.push_back({wires.image(), letter(static_cast<int>(k)) + states[k].caption});
    patterned.push_back({Canvas(picture, footage.format, part, kPanelWidth).image(), "patterned"});
  }
  return sheet({wire_frames, patterned});
}

}  // namespace fbs::figures
