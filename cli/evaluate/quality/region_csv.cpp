// Face regions from a table of landmarks: read_region_csv.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "cli/evaluate/quality/face_regions.h"

namespace fbs::cli {
namespace {

constexpr std::size_t kLandmarks = 68;
constexpr std::size_t kMinLandmarks = 30;
constexpr double kMinConfidence = 0.5;
constexpr double kMaxFrame = 1e7;
constexpr double kMaxCoordinate = 1e5;  // pixels

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r\"");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r\"") - begin + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> out;
  for (std::size_t at = 0;;) {
    const std::size_t comma = line.find(',', at);
    out.push_back(trimmed(line.substr(at, comma - at)));
    if (comma == std::string::npos) return out;
    at = comma + 1;
  }
}

/// NaN if the cell is not a number.
double number(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return cell.empty() || *end != '\0' ? std::numeric_limits<double>::quiet_NaN() : value;
}

/// Positions of the columns in a line.
struct Columns {
  std::array<std::size_t, kLandmarks> x{}, y{};
  std::optional<std::size_t> frame, success, confidence;
  std::size_t count = 0;
};

std::optional<Columns> columns_of(const std::string& header) {
  const auto names = cells_of(header);
  const auto find = [&](const std::string& name) -> std::optional<std::size_t> {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) return std::nullopt;
    return static_cast<std::size_t>(at - names.begin());
  };
  Columns columns{.frame = find("frame"), .success = find("success"), .confidence = find("confidence")};
  columns.count = names.size();
  for (std::size_t k = 0; k < kLandmarks; ++k) {
    const std::string n = std::to_string(k);
    const auto x = find("x" + n) ? find("x" + n) : find("x_" + n);
    const auto y = find("y" + n) ? find("y" + n) : find("y_" + n);
    if (!x || !y) return std::nullopt;
    columns.x.at(k) = *x;
    columns.y.at(k) = *y;
  }
  return columns;
}

FaceOutline hull_of(const std::vector<std::string>& cells, const Columns& columns) {
  if (columns.success && number(cells[*columns.success]) == 0) return {};
  if (columns.confidence && !(number(cells[*columns.confidence]) >= kMinConfidence)) return {};
  std::vector<cv::Point> points, hull;
  for (std::size_t k = 0; k < kLandmarks; ++k) {
    const double x = number(cells[columns.x.at(k)]), y = number(cells[columns.y.at(k)]);
    if (std::abs(x) < kMaxCoordinate && std::abs(y) < kMaxCoordinate)
      points.emplace_back(cvRound(x), cvRound(y));
  }
  FaceOutline out;
  if (points.size() < kMinLandmarks) return out;
  cv::convexHull(points, hull);
  for (const cv::Point& p : hull) out.push_back({p.x, p.y});
  return out;
}

}  // namespace

Result<FaceRegions> read_region_csv(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line))
    return fail(ErrorCode::kIo, file + ": cannot read a table of landmarks");
  const auto columns = columns_of(line);
  if (!columns)
    return fail(ErrorCode::kInvalidArgument,
                file + ": has no columns x0,y0 ... x67,y67 of landmarks in pixels");
  std::map<std::int64_t, FaceOutline> faces;  // by frame
  for (std::int64_t n = 0; std::getline(in, line);) {
    if (trimmed(line).empty()) continue;
    const auto cells = cells_of(line);
    const double frame = cells.size() == columns->count && columns->frame ? number(cells[*columns->frame])
                                                                          : static_cast<double>(n);
    if (cells.size() != columns->count || !(frame >= 0 && frame <= kMaxFrame))
      return fail(ErrorCode::kInvalidArgument,
                  file + ": line " + std::to_string(n + 2) + " does not have a value for each column");
    faces.try_emplace(static_cast<std::int64_t>(frame), hull_of(cells, *columns));
    ++n;
  }
  if (faces.empty()) return fail(ErrorCode::kInvalidArgument, file + ": has no line of landmarks");
  // OpenFace counts from 1, our own export from 0.
  const std::int64_t first = faces.begin()->first == 0 ? 0 : columns->frame ? 1 : 0;
  FaceRegions regions{file, {}};
  regions.outlines.resize(static_cast<std::size_t>(faces.rbegin()->first - first + 1));
  for (auto& [frame, outline] : faces)
    regions.outlines[static_cast<std::size_t>(frame - first)] = std::move(outline);
  return regions;
}

}  // namespace fbs::cli
