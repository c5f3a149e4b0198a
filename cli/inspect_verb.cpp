// fbs inspect: what a stream contains and the size of each part.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/stream_file.h"
#include "cli/verbs.h"

namespace fbs::cli {
namespace {

struct Summary {
  ByteCount bytes;
  VideoFormat format;
  QuantiserSteps steps;
  std::uint64_t pictures = 0;
  double seconds = 0;
  std::size_t patterns = 0;
  bool face = false;
  PartCosts motion{};  ///< 1/256 bit
};

/// Bytes of motion for each part of the state, for durations, and for the rest: packet headers, checksums,
/// code terminations.
std::vector<std::pair<std::string, double>> motion_by_part(const Summary& s) {
  std::vector<std::pair<std::string, double>> out;
  double rest = static_cast<double>(s.bytes.motion);
  for (std::size_t p = 0; p < s.motion.size(); ++p) {
    const double bytes = static_cast<double>(s.motion[p]) / (256 * 8);
    rest -= bytes;
    out.emplace_back(p < kPartCount ? std::string(kPartNames[p]) : "durations", bytes);
  }
  out.emplace_back("packets", rest);
  return out;
}

nlohmann::json to_json(const Summary& s) {
  const ByteCount& b = s.bytes;
  nlohmann::json by_part;
  for (const auto& [part, bytes] : motion_by_part(s)) by_part[part] = std::lround(bytes);
  return {{"bytes",
           {{"total", b.total},
            {"startup", b.startup},
            {"geometry", b.geometry},
            {"patterns", b.patterns},
            {"motion", b.motion},
            {"index", b.index},
            {"other", b.other}}},
          {"motion", by_part},
          {"frames", s.pictures},
          {"fps", static_cast<double>(s.format.frame_rate.num) / s.format.frame_rate.den},
          {"width", s.format.width},
          {"height", s.format.height},
          {"seconds", s.seconds},
          {"patterns", s.patterns},
          {"face", s.face},
          {"steps",
           {{"rotation", s.steps.rotation},
            {"translation", s.steps.translation},
            {"log_scale", s.steps.log_scale},
            {"light", s.steps.light},
            {"control", s.steps.control}}}};
}

void print(const std::string& name, const Summary& s) {
  const ByteCount& b = s.bytes;
  const auto kbps = [&](std::uint64_t bytes) {
    return s.seconds > 0 ? 8e-3 * static_cast<double>(bytes) / s.seconds : 0;
  };
  const auto line = [&](const char* part, std::uint64_t bytes) {
    std::printf("  %-13s %9llu bytes %9.3f kbit/s\n", part, static_cast<unsigned long long>(bytes),
                kbps(bytes));
  };
  std::printf("%s: %d x %d, %.3f pictures/s, %llu pictures, %.2f s, %zu pattern%s%s\n", name.c_str(),
              s.format.width, s.format.height,
              static_cast<double>(s.format.frame_rate.num) / s.format.frame_rate.den,
              static_cast<unsigned long long>(s.pictures), s.seconds, s.patterns, s.patterns == 1 ? "" : "s",
              s.face ? "" : ", no face");
  line("geometry", b.geometry);
  line("patterns", b.patterns);
  line("motion", b.motion);
  for (const auto& [part, bytes] : motion_by_part(s))
    if (bytes >= 0.5)
      std::printf("    %-14s %6.0f bytes %9.3f kbit/s\n", part.c_str(), bytes,
                  s.seconds > 0 ? 8e-3 * bytes / s.seconds : 0);
  line("index", b.index);
  line("other", b.other);
  line("total", b.total);
  std::printf("  needed before the first picture: %llu bytes\n", static_cast<unsigned long long>(b.startup));
  std::printf(
      "  quantiser steps: rotation %.3f deg, translation %.3f px, scale %.2f %%, control points %.2f %% of "
      "the eye "
      "distance\n",
      s.steps.rotation * 360.0 / 65536, s.steps.translation / 64.0, s.steps.log_scale * 69.3 / 4096,
      s.steps.control * 100.0 / kUnitsPerEyeDistance);
}

}  // namespace

Result<void> run_inspect(const InspectArguments& arguments) {
  auto file = StreamFile::open(arguments.input);
  if (!file) return fail(file.error());
  StreamDecoder& decoder = file->decoder();
  Summary s;
  for (;;) {
    auto status = file->next();
    if (!status) return fail(status.error());
    if (*status == DecodeStatus::kEnd) break;
    s.seconds += decoder.duration() / 90000.0;
  }
  s.bytes = decoder.bytes();
  s.format = decoder.format();
  s.pictures = decoder.pictures();
  s.patterns = decoder.scene().patterns.size();
  s.face = decoder.scene().geometry.has_value();
  s.steps = decoder.scene().setup.steps;
  s.motion = decoder.motion_costs();
  if (arguments.json)
    std::printf("%s\n", to_json(s).dump(1).c_str());
  else
    print(file->name(), s);
  return {};
}

}  // namespace fbs::cli
