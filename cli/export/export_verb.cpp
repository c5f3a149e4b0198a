// fbs export: the motion of a stream as a table.
#include <array>
#include <cmath>
#include <cstdio>

#include "cli/export/export_arguments.h"
#include "cli/output_check.h"
#include "cli/stream/stream_file.h"
#include "cli/video/atomic_file.h"
#include "decoder/scene_face.h"

namespace fbs::cli {
namespace {

std::string header() {
  std::string line = "frame,rx_deg,ry_deg,rz_deg,tx_px,ty_px,scale";
  for (int k = 0; k < kLandmarkCount; ++k) line += ",x" + std::to_string(k) + ",y" + std::to_string(k);
  return line + "\n";
}

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, ",%.3f", v);
  return text;
}

std::string row(std::uint64_t frame, const StreamDecoder& decoder) {
  std::string line = std::to_string(frame);
  const SceneGeometry* face = face_of(decoder.scene());
  if (face == nullptr) {
    for (int k = 0; k < 6 + 2 * kLandmarkCount; ++k) line += ",nan";
    return line + "\n";
  }
  const HeadPose pose = head_pose(decoder.state());
  for (const std::int32_t angle : {pose.pitch, pose.yaw, pose.roll}) line += number(angle * 360.0 / 65536);
  line +=
      number(pose.shift_x / 64.0) + number(pose.shift_y / 64.0) + number(std::exp2(pose.log_scale / 4096.0));
  const auto vertices = face->project_vertices(decoder.state());
  for (const std::uint16_t v : generic_head().landmark_vertex) {
    const glm::ivec3 p = vertices[v];
    line += number(p.x / 64.0) + number(p.y / 64.0);
  }
  return line + "\n";
}

}  // namespace

Result<Outcome> run_export(const ExportArguments& arguments) {
  if (!arguments.output.ends_with(".csv"))
    return fail(ErrorCode::kUnsupported, arguments.output + ": unknown format; use .csv");
  const std::array inputs{NamedFile{"INPUT", arguments.input}};
  const std::array outputs{NamedFile{"OUTPUT", arguments.output}};
  if (auto checked = check_distinct(inputs, outputs); !checked) return fail(checked.error());
  auto file = StreamFile::open(arguments.input);
  if (!file) return fail(file.error());
  auto out = AtomicFile::create(arguments.output);
  if (!out) return fail(out.error());
  if (out->replaced_leftover()) print_replaced_leftover(arguments.output);
  const auto write = [&](const std::string& text) {
    return out->write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  if (auto written = write(header()); !written) return fail(written.error());
  for (std::uint64_t frame = 0;; ++frame) {
    auto status = file->next();
    if (!status) return fail(status.error());
    if (*status == DecodeStatus::kEnd) break;
    if (auto written = write(row(frame, file->decoder())); !written) return fail(written.error());
  }
  return out->commit().map([] { return Outcome::kComplete; });
}

}  // namespace fbs::cli
