#include "decoder/export/face_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "decoder/expression/face_movements.h"
#include "decoder/head/head_deformation.h"
#include "decoder/head/head_projection.h"

namespace fbs {
namespace {

constexpr double kDegreesPerTurn = 360;
constexpr int kPixelDigits = 3, kTimeDigits = 6, kWeightDigits = 4;  ///< after the decimal point

std::string number(double v, int digits) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, v);
  const std::string out = text.data();
  return out.find_first_of("123456789") == std::string::npos && out.front() == '-' ? out.substr(1) : out;
}

/// A number of a face in the order of the columns, and its name in CSV.
struct Column {
  std::string name;
  std::string value;
};

std::vector<Column> pose_columns(const FaceNumbers& face) {
  constexpr std::array kRotations{"rx_deg", "ry_deg", "rz_deg"};
  std::vector<Column> out;
  for (std::size_t i = 0; i < kRotations.size(); ++i)
    out.push_back({kRotations[i], number(face.rotation_deg[i], kPixelDigits)});
  out.push_back({"tx_px", number(face.translation_px.x, kPixelDigits)});
  out.push_back({"ty_px", number(face.translation_px.y, kPixelDigits)});
  out.push_back({"scale", number(face.scale, kPixelDigits)});
  return out;
}

std::vector<Column> landmark_columns(const FaceNumbers& face) {
  std::vector<Column> out;
  for (std::size_t k = 0; k < face.landmarks.size(); ++k) {
    const std::string place = std::to_string(k);
    out.push_back({std::string("x").append(place), number(face.landmarks[k].x, kPixelDigits)});
    out.push_back({std::string("y").append(place), number(face.landmarks[k].y, kPixelDigits)});
  }
  return out;
}

std::vector<Column> gaze_columns(const FaceNumbers& face) {
  return {{"gaze_x_deg", number(face.gaze_deg.x, kPixelDigits)},
          {"gaze_y_deg", number(face.gaze_deg.y, kPixelDigits)}};
}

std::vector<Column> blendshape_columns(const FaceNumbers& face) {
  std::vector<Column> out;
  for (std::size_t i = 0; i < blendshape_names().size(); ++i)
    out.push_back({blendshape_names()[i], number(face.blendshapes[i], kWeightDigits)});
  return out;
}

/// Columns for the time and for how far the row can be trusted.
std::vector<Column> trust_columns(const FaceRow& row) {
  return {{"timestamp", number(row.seconds, kTimeDigits)},
          {"confidence", number(row.confidence, kWeightDigits)},
          {"success", row.success ? "1" : "0"}};
}

FaceNumbers no_numbers() {
  FaceNumbers face;
  face.blendshapes.resize(blendshape_names().size());
  return face;
}

void append_csv(std::string& line, const std::vector<Column>& columns, std::string Column::*what) {
  for (const Column& c : columns) line.append(",").append(c.*what);
}

/// A line of CSV: the columns that programs find by their place come first.
std::string csv_line(const FaceRow& row, std::string Column::*what, std::string first) {
  FaceNumbers face = row.face ? *row.face : no_numbers();
  const bool lacks = !row.face && what == &Column::value;
  const auto append = [&](std::vector<Column> columns) {
    if (lacks)
      for (Column& c : columns) c.value = "nan";
    append_csv(first, columns, what);
  };
  append(pose_columns(face));
  append(landmark_columns(face));
  append_csv(first, trust_columns(row), what);
  append(gaze_columns(face));
  append(blendshape_columns(face));
  return first + "\n";
}

std::string json_members(const std::vector<Column>& columns) {
  std::string out;
  for (const Column& c : columns) out += (out.empty() ? "\"" : ", \"") + c.name + "\": " + c.value;
  return out;
}

std::string json_row(const FaceRow& row) {
  std::string out = "    {\"frame\": " + std::to_string(row.frame) +
                    ", \"timestamp\": " + number(row.seconds, kTimeDigits) +
                    ", \"confidence\": " + number(row.confidence, kWeightDigits) +
                    ", \"success\": " + (row.success ? "true" : "false");
  if (!row.face) return out + ", \"face\": null}";
  const FaceNumbers& face = *row.face;
  std::string points;
  for (const glm::dvec2& p : face.landmarks)
    points +=
        (points.empty() ? "[" : ", [") + number(p.x, kPixelDigits) + ", " + number(p.y, kPixelDigits) + "]";
  return out + ",\n     \"face\": {\"pose\": {" + json_members(pose_columns(face)) +
         "},\n       \"gaze\": {" + json_members(gaze_columns(face)) + "},\n       \"landmarks\": [" +
         points + "],\n       \"blendshapes\": {" + json_members(blendshape_columns(face)) + "}}}";
}

std::string json_head(const VideoFormat& video) {
  return "{\n  \"generator\": \"fbs\",\n  \"width\": " + std::to_string(video.width) +
         ",\n  \"height\": " + std::to_string(video.height) + ",\n  \"frame_rate\": [" +
         std::to_string(video.frame_rate.num) + ", " + std::to_string(video.frame_rate.den) +
         "],\n  \"landmark_scheme\": \"iBUG-68\",\n  \"frames\": [";
}

}  // namespace

FaceNumbers FaceMeasure::operator()(const Geometry& head, const State& state) {
  FaceNumbers out;
  const HeadPose pose = head_pose(state);
  const std::array<std::int32_t, 3> turns{pose.pitch, pose.yaw, pose.roll};
  for (std::size_t i = 0; i < turns.size(); ++i) out.rotation_deg[i] = turns[i] * kDegreesPerTurn / 65536;
  constexpr double kPixel = 1 << kScreenOneLog2;
  out.translation_px = {pose.shift_x / kPixel, pose.shift_y / kPixel};
  out.scale = std::exp2(pose.log_scale / 4096.0);
  const auto vertices = project_vertices(head, state);
  for (std::size_t k = 0; k < out.landmarks.size(); ++k) {
    const glm::ivec3 p = vertices[head.wire_frame().vertex_of_landmark(k)];
    out.landmarks[k] = {p.x / kPixel, p.y / kPixel};
  }
  const glm::dvec2 pupils = glm::dvec2(state.control[feature(FeatureId::kPupilRight).first_control] +
                                       state.control[feature(FeatureId::kPupilLeft).first_control]) /
                            2.0;
  const auto degrees = [](double offset) {
    return std::asin(std::clamp(offset / kEyeballRadius, -1.0, 1.0)) * 180 / std::numbers::pi;
  };
  out.gaze_deg = {degrees(pupils.x), degrees(pupils.y)};
  out.blendshapes = blendshapes_(head, state);
  return out;
}

std::string FaceTable::begin(const VideoFormat& video) const {
  return format_ == TableFormat::kCsv ? csv_line({}, &Column::name, "frame") : json_head(video);
}

std::string FaceTable::row(const FaceRow& row) {
  if (format_ == TableFormat::kCsv) return csv_line(row, &Column::value, std::to_string(row.frame));
  const std::string before = first_ ? "\n" : ",\n";
  first_ = false;
  return before + json_row(row);
}

std::string FaceTable::end() const {
  return format_ == TableFormat::kCsv ? "" : "\n  ]\n}\n";
}

}  // namespace fbs
