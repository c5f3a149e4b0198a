#include "encoder/find/marks.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "common/picture.h"
#include "encoder/find/find_tuning.h"
#include "encoder/find/landmarks.h"

namespace fbs {
namespace {

std::optional<glm::dvec2> point_of(const nlohmann::json& j) {
  if (!j.is_array() || j.size() != 2 || !j[0].is_number() || !j[1].is_number()) return std::nullopt;
  const glm::dvec2 p(j[0].get<double>(), j[1].get<double>());
  if (!(std::abs(p.x) <= 2 * kMaxPictureSize && std::abs(p.y) <= 2 * kMaxPictureSize)) return std::nullopt;
  return p;
}

Result<Marks> landmarks_of(const nlohmann::json& list) {
  if (!list.is_array() || list.size() != kLandmarkCount)
    return fail(ErrorCode::kInvalidArgument, "\"landmarks\" does not hold 68 points");
  Marks marks;
  for (int k = 0; k < kLandmarkCount; ++k) {
    const auto p = point_of(list[k]);
    if (!p) return fail(ErrorCode::kInvalidArgument, "landmark " + std::to_string(k) + " is not [x, y]");
    marks.set_landmark(k, *p);
  }
  return marks;
}

}  // namespace

std::optional<glm::dvec2> Marks::landmark(int ibug) const {
  return vertex[vertex_of_landmark(ibug)];
}

void Marks::set_landmark(int ibug, glm::dvec2 p) {
  vertex[vertex_of_landmark(ibug)] = p;
}

std::optional<std::array<glm::dvec2, 2>> Marks::eyes() const {
  std::array<glm::dvec2, 2> centre{};
  for (std::size_t eye = 0; eye < 2; ++eye) {
    glm::dvec2 sum(0);
    int count = 0;
    for (int k = 0; k < ibug::kEyePoints; ++k) {
      if (const auto p = landmark(ibug::kEyesFirst + ibug::kEyePoints * static_cast<int>(eye) + k)) {
        sum += *p;
        ++count;
      }
    }
    if (count == 0) return std::nullopt;
    centre[eye] = sum / static_cast<double>(count);
  }
  return centre;
}

Result<Marks> read_marks(const std::string& path) {
  std::ifstream file(path);
  if (!file) return fail(ErrorCode::kIo, "cannot read: " + std::generic_category().message(errno));
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object()) return fail(ErrorCode::kInvalidArgument, "not a JSON object of marks");
  Marks marks;
  if (json.contains("landmarks")) {
    auto listed = landmarks_of(json["landmarks"]);
    if (!listed) return listed;
    marks = *listed;
  }
  for (const auto& item : json.items()) {
    const std::string& name = item.key();
    if (name == "landmarks") continue;
    const auto vertices = generic_head().vertices;
    const auto found =
        std::find_if(vertices.begin(), vertices.end(), [&](const HeadVertex& v) { return v.name == name; });
    if (found == vertices.end())
      return fail(ErrorCode::kInvalidArgument, "no vertex is named \"" + name + "\"");
    const auto p = point_of(item.value());
    if (!p) return fail(ErrorCode::kInvalidArgument, "\"" + name + "\" is not [x, y]");
    marks.vertex[found - vertices.begin()] = *p;
  }
  const auto eyes = marks.eyes();
  if (!eyes) return fail(ErrorCode::kInvalidArgument, "no mark on one of the eyes");
  if ((*eyes)[1].x - (*eyes)[0].x < find_tuning::kMinEyeDistancePx)
    return fail(ErrorCode::kInvalidArgument, "the eyes are less than 4 pixels apart or the wrong way round");
  return marks;
}

}  // namespace fbs
