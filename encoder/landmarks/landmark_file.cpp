#include "encoder/landmarks/landmark_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <system_error>
#include <vector>

#include "encoder/landmarks/shape.h"

namespace fbs {
namespace {

constexpr double kLeastConfidence = 0.5;
constexpr float kLeastEyeDistance = 4;  // pixels; as for marks
constexpr double kMaxFrame = 1e9;       // more than a year of pictures
constexpr const char* kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> out;
  for (;;) {
    const std::size_t comma = line.find(',');
    out.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return out;
    line.remove_prefix(comma + 1);
  }
}

/// An empty field is nan. Nothing when it is not a number.
std::optional<double> number_of(std::string_view field) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (field.front() == '+') field.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return value;
}

auto fail_at(std::size_t line, const std::string& text) {
  return fail(ErrorCode::kInvalidArgument, "line " + std::to_string(line) + ": " + text);
}

/// Index of each column.
struct Columns {
  std::size_t count = 0;  ///< of all columns
  std::size_t frame = 0;
  std::optional<std::size_t> success, confidence, face;
  std::array<std::array<std::size_t, 2>, kLandmarkCount> point{};
  double first_frame = 0;  ///< number of the first picture
};

Result<Columns> columns_of(std::string_view header) {
  const std::vector<std::string_view> names = fields_of(header);
  const auto find = [&](const std::string& name) -> std::optional<std::size_t> {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) return std::nullopt;
    return static_cast<std::size_t>(at - names.begin());
  };
  Columns out;
  out.count = names.size();
  const bool open_face = find("x_0").has_value();
  const std::string joint = open_face ? "_" : "";
  for (std::size_t k = 0; k < kLandmarkCount; ++k)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const std::string name = (axis == 0 ? "x" : "y") + joint + std::to_string(k);
      const auto at = find(name);
      if (!at) return fail_at(1, "no column " + name + "; columns are frame, x0, y0 to x67, y67");
      out.point[k][axis] = *at;
    }
  const auto frame = find("frame");
  if (!frame) return fail_at(1, "no column frame");
  out.frame = *frame;
  out.success = find("success");
  if (!out.success) out.success = find("found");
  out.confidence = find("confidence");
  out.face = find("face_id");
  out.first_frame = open_face ? 1 : 0;
  return out;
}

/// A row as numbers.
using Row = std::vector<double>;

Result<Row> row_of(std::string_view line, std::size_t number, const Columns& columns) {
  const std::vector<std::string_view> fields = fields_of(line);
  if (fields.size() != columns.count)
    return fail_at(
        number, std::to_string(fields.size()) + " fields, the header has " + std::to_string(columns.count));
  Row out(fields.size(), 0);
  const auto read = [&](std::size_t column) {
    const auto value = number_of(fields[column]);
    if (value) out[column] = *value;
    return value.has_value();
  };
  std::vector<std::size_t> used = {columns.frame};
  for (const auto& optional : {columns.success, columns.confidence, columns.face})
    if (optional) used.push_back(*optional);
  for (const auto& point : columns.point) used.insert(used.end(), point.begin(), point.end());
  for (const std::size_t column : used)
    if (!read(column))
      return fail_at(number, "field " + std::to_string(column + 1) + ", \"" +
                                 std::string(fields[column].substr(0, 20)) + "\", is no number");
  const double frame = out[columns.frame] - columns.first_frame;
  if (!(frame >= 0 && frame <= kMaxFrame) || frame != std::floor(frame))
    return fail_at(number, "frame \"" + std::string(fields[columns.frame].substr(0, 20)) +
                               "\" is no number of a picture, counted from " +
                               (columns.first_frame > 0 ? "1" : "0"));
  return out;
}

/// The landmarks of a row, unless it belongs to a picture without a face.
std::optional<LandmarkPoints> points_of(const Row& row, const Columns& columns) {
  if (columns.success && !(row[*columns.success] > 0)) return std::nullopt;
  if (columns.confidence && !(row[*columns.confidence] >= kLeastConfidence)) return std::nullopt;
  LandmarkPoints out;
  for (std::size_t k = 0; k < kLandmarkCount; ++k) {
    out[k] = glm::dvec2(row[columns.point[k][0]], row[columns.point[k][1]]);
    if (!std::isfinite(out[k].x) || !std::isfinite(out[k].y)) return std::nullopt;
  }
  return out;
}

/// Whether a face can have these landmarks.
bool shows_face(const LandmarkPoints& points, int width, int height) {
  Shape shape;
  std::copy(points.begin(), points.end(), shape.begin());
  const glm::vec2 middle = mean_of(shape);
  return eye_distance(shape) >= kLeastEyeDistance && middle.x >= 0 && middle.y >= 0 &&
         middle.x <= static_cast<float>(width) && middle.y <= static_cast<float>(height);
}

}  // namespace

Result<LandmarkTrack> parse_landmarks(std::string_view text, int width, int height) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // byte order mark
  std::optional<Columns> columns;
  LandmarkTrack out;
  std::map<std::uint64_t, std::size_t> line_of;  // of each picture
  bool any = false;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (!columns) {
      auto found = columns_of(line);
      if (!found) return fail(found.error());
      columns = *found;
      continue;
    }
    if (trimmed(line).empty()) continue;
    const auto row = row_of(line, number, *columns);
    if (!row) return fail(row.error());
    if (columns->face && (*row)[*columns->face] != 0) continue;
    const auto picture = static_cast<std::uint64_t>((*row)[columns->frame] - columns->first_frame);
    if (const auto [at, is_new] = line_of.emplace(picture, number); !is_new)
      return fail_at(number, "the same picture as line " + std::to_string(at->second));
    if (const auto points = points_of(*row, *columns)) {
      any = true;
      if (shows_face(*points, width, height)) out.emplace(picture, *points);
    }
  }
  if (!columns) return fail(ErrorCode::kInvalidArgument, "empty, not a table of landmarks");
  if (!any) return fail(ErrorCode::kInvalidArgument, "no row has a face");
  if (out.empty())
    return fail(ErrorCode::kInvalidArgument, "no face within " + std::to_string(width) + "x" +
                                                 std::to_string(height) +
                                                 " pixels: landmarks of another video, or not in pixels");
  return out;
}

Result<LandmarkTrack> read_landmarks(const std::string& path, int width, int height) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(ErrorCode::kIo, "cannot read: " + std::generic_category().message(errno));
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) return fail(ErrorCode::kIo, "cannot read: " + std::generic_category().message(errno));
  return parse_landmarks(text, width, height);
}

}  // namespace fbs
