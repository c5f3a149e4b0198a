#include "cli/evaluate/rate_distortion/rd_point.h"

#include <utility>

namespace fbs::cli {
namespace {

using nlohmann::json;

json error_json(const SquaredError& e) {
  return json::array({e.sum, e.count});
}

SquaredError read_error(const json& j) {
  return {j.at(0), j.at(1)};
}

json area_json(const AreaQuality& a) {
  return json::array({error_json(a.y), error_json(a.u), error_json(a.v), a.ssim, a.ms_ssim});
}

AreaQuality read_area(const json& j) {
  return {read_error(j.at(0)), read_error(j.at(1)), read_error(j.at(2)), j.at(3), j.at(4)};
}

}  // namespace

json quality_json(const RdPoint& point) {
  json pictures = json::array();
  for (const PictureQuality& p : point.pictures) {
    json one = {{"frame", area_json(p.frame)}};
    if (p.face) one["face"] = area_json(*p.face);
    pictures.push_back(std::move(one));
  }
  json out = {{"pictures", std::move(pictures)}};
  if (point.vmaf) out["vmaf"] = *point.vmaf;
  return out;
}

bool read_quality(const json& j, RdPoint& point) {
  try {
    std::vector<PictureQuality> pictures;
    for (const json& one : j.at("pictures")) {
      PictureQuality& p = pictures.emplace_back();
      p.frame = read_area(one.at("frame"));
      if (one.contains("face")) p.face = read_area(one.at("face"));
    }
    std::optional<double> vmaf;
    if (j.contains("vmaf")) vmaf = j.at("vmaf").get<double>();
    point.pictures = std::move(pictures);
    point.vmaf = vmaf;
    return true;
  } catch (const json::exception&) {
    return false;
  }
}

}  // namespace fbs::cli
