#include "tests/talker/talker_files.h"

#include <iomanip>
#include <span>

namespace fbs::talker {
namespace {

/// Numbers in a row, each after a comma.
void write_numbers(std::ostream& out, std::span<const float> numbers) {
  for (const float number : numbers) out << ',' << number;
}

}  // namespace

void write_y4m_header(std::ostream& out, const Settings& s) {
  out << "YUV4MPEG2 W" << s.width << " H" << s.height << " F" << s.frame_rate.num << ':' << s.frame_rate.den
      << " Ip A1:1 C420jpeg XCOLORRANGE=LIMITED\n";
}

void write_y4m_frame(std::ostream& out, const Picture& picture) {
  out << "FRAME\n";
  for (const Plane* plane : {&picture.y, &picture.u, &picture.v}) {
    out.write(reinterpret_cast<const char*>(plane->samples.data()),
              static_cast<std::streamsize>(plane->samples.size()));
  }
}

void write_truth_header(std::ostream& out) {
  out << "frame,rx_deg,ry_deg,rz_deg,tx_px,ty_px,scale";
  for (int i = 0; i < kLandmarkTotal; ++i) out << ",x" << i << ",y" << i;
  out << ",mouth_open,eye_open_right,eye_open_left,brow_right,brow_left";
  for (int i = 0; i < kLandmarkTotal; ++i) out << ",v" << i;
  out << '\n';
}

void write_truth_line(std::ostream& out, const Talker& talker, int frame) {
  const auto [pose, e, light] = talker.truth(frame);
  out << std::fixed << std::setprecision(4) << frame;
  write_numbers(out, std::array{pose.pitch_deg, pose.yaw_deg, pose.roll_deg, pose.shift_px.x, pose.shift_px.y,
                                pose.scale_px});
  for (const glm::vec2 p : talker.points(frame)) write_numbers(out, std::array{p.x, p.y});
  write_numbers(out, std::array{e.mouth_open, e.eye_open_right, e.eye_open_left, e.brow_right, e.brow_left});
  for (const bool seen : talker.visible(frame)) out << (seen ? ",1" : ",0");
  out << '\n';
}

void write_marks(std::ostream& out, const Talker& talker, int frame) {
  out << std::fixed << std::setprecision(4) << "{\"landmarks\": [";
  const char* separator = "";
  for (const glm::vec2 p : talker.points(frame)) {
    out << separator << '[' << p.x << ", " << p.y << ']';
    separator = ", ";
  }
  out << "]}\n";
}

}  // namespace fbs::talker
