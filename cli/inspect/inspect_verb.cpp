// fbs inspect: the content of a stream and the size of each part.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "cli/command_line/verb.h"
#include "cli/inspect/pattern_use.h"
#include "cli/stream/byte_count_json.h"
#include "cli/stream/picture_sources.h"
#include "cli/stream/stream_file.h"
#include "decoder/scene/scene_face.h"
#include "decoder/stream/packet_list.h"
#include "decoder/stream/scene_index.h"

namespace fbs::cli {
namespace {

constexpr const char* kInspectExamples =
    "Examples:\n"
    "  fbs inspect talk.fbs                            size of each part\n"
    "  fbs inspect talk.fbs --json\n"
    "  fbs inspect broken.fbs --packets                every packet, and what is wrong with it";

struct InspectArguments {
  std::string input;
  bool json = false;
  bool packets = false;  ///< list them
};

struct PatternSummary {
  std::uint64_t picture = 0;
  double seconds = 0;
  std::uint64_t bytes = 0;
  bool reduced = false;
  std::array<double, kRegionCount> share{};  ///< of each region
};

struct Summary {
  ByteCount bytes;
  VideoFormat format;
  QuantiserSteps steps;
  std::uint64_t pictures = 0;
  double seconds = 0;
  std::vector<PatternSummary> patterns;  ///< in order of arrival
  std::vector<SceneEntry> scenes;
  bool ended = false;  ///< has an end packet
  bool face = false;
  PartBitsX256 motion{};
};

/// Bytes of motion for each part of the state, for durations, for blend packets, and for the rest: headers of
/// motion packets, checksums, code terminations.
std::vector<std::pair<std::string, double>> motion_by_part(const Summary& s) {
  std::vector<std::pair<std::string, double>> out;
  const auto blend = static_cast<double>(s.bytes.blend);
  double rest = static_cast<double>(s.bytes.motion) - blend;
  for (std::size_t p = 0; p < s.motion.size(); ++p) {
    const double bytes = static_cast<double>(s.motion[p]) / (256 * 8);
    rest -= bytes;
    out.emplace_back(p < kPartCount ? std::string(kPartNames[p]) : "durations", bytes);
  }
  out.emplace_back("blend", blend);
  out.emplace_back("packets", rest);
  return out;
}

nlohmann::json to_json(const PatternSummary& p) {
  nlohmann::json share;
  for (std::size_t r = 0; r < kRegionCount; ++r) share[std::string(kRegionNames[r])] = p.share[r];
  return {{"picture", p.picture},
          {"seconds", p.seconds},
          {"bytes", p.bytes},
          {"reduced", p.reduced},
          {"share", share}};
}

bool is_packet(const PacketEntry& entry) {
  return entry.type != kDamage;
}

double seconds_of(std::uint64_t time) {
  return static_cast<double>(time) / kTicksPerSecond;
}

nlohmann::json to_json(const SceneEntry& s) {
  return {{"picture", s.before.pictures},
          {"seconds", seconds_of(s.before.time)},
          {"offset", s.offset},
          {"bytes", s.bytes},
          {"face", s.face},
          {"joinable", s.is_joinable},
          {"return", s.is_return}};
}

nlohmann::json to_json(const Summary& s) {
  nlohmann::json by_part;
  for (const auto& [part, bytes] : motion_by_part(s)) by_part[part] = std::lround(bytes);
  nlohmann::json patterns = nlohmann::json::array();
  for (const PatternSummary& p : s.patterns) patterns.push_back(to_json(p));
  nlohmann::json scenes = nlohmann::json::array();
  for (const SceneEntry& scene : s.scenes) scenes.push_back(to_json(scene));
  return {{"bytes", byte_count_json(s.bytes)},
          {"motion", by_part},
          {"frames", s.pictures},
          {"fps", static_cast<double>(s.format.frame_rate.num) / s.format.frame_rate.den},
          {"width", s.format.width},
          {"height", s.format.height},
          {"seconds", s.seconds},
          {"pattern_count", s.patterns.size()},
          {"patterns", patterns},
          {"scenes", scenes},
          {"ended", s.ended},
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
    std::printf("  %-16s %9llu bytes %9.3f kbit/s\n", part, static_cast<unsigned long long>(bytes),
                kbps(bytes));
  };
  std::printf("%s: %d x %d, %.3f pictures/s, %llu pictures, %.2f s, %zu pattern%s%s\n", name.c_str(),
              s.format.width, s.format.height,
              static_cast<double>(s.format.frame_rate.num) / s.format.frame_rate.den,
              static_cast<unsigned long long>(s.pictures), s.seconds, s.patterns.size(),
              s.patterns.size() == 1 ? "" : "s", s.face ? "" : ", no face");
  line("geometry", b.geometry);
  line("patterns", b.patterns);
  for (const PatternSummary& p : s.patterns)
    std::printf("    %-14s %9llu bytes %9.2f s%s\n", ("picture " + std::to_string(p.picture)).c_str(),
                static_cast<unsigned long long>(p.bytes), p.seconds, p.reduced ? ", reduced size" : "");
  line("motion", b.motion);
  for (const auto& [part, bytes] : motion_by_part(s))
    if (bytes >= 0.5)
      std::printf("    %-14s %9.0f bytes %9.3f kbit/s\n", part.c_str(), bytes,
                  s.seconds > 0 ? 8e-3 * bytes / s.seconds : 0);
  if (b.sound > 0) line("sound", b.sound);
  line("other", b.other);
  line("total", b.total);
  std::printf("  scenes: %zu%s\n", s.scenes.size(), s.ended ? "" : "; no end packet: cut, or not ended yet");
  for (const SceneEntry& scene : s.scenes)
    std::printf("    %-14s %9llu bytes %9.2f s, at byte %llu, %s%s\n",
                ("picture " + std::to_string(scene.before.pictures)).c_str(),
                static_cast<unsigned long long>(scene.bytes), seconds_of(scene.before.time),
                static_cast<unsigned long long>(scene.offset), scene.face ? "a face" : "no face",
                scene.is_return     ? ", a return"
                : scene.is_joinable ? ""
                                    : ", not to be joined");
  std::printf("  needed before the first picture: %llu bytes\n", static_cast<unsigned long long>(b.startup));
  std::printf(
      "  quantiser steps: rotation %.3f deg, translation %.3f px, scale %.2f %%, control points %.2f %% of "
      "the eye "
      "distance\n",
      s.steps.rotation * 360.0 / 65536, s.steps.translation / 64.0, s.steps.log_scale * 69.3 / 4096,
      s.steps.control * 100.0 / kUnitsPerEyeDistance);
}

std::vector<PatternSummary> patterns_of(const StreamDecoder& decoder, const PatternUse& use) {
  std::vector<PatternSummary> out;
  for (const PatternRecord& record : decoder.pattern_records()) {
    PatternSummary p{record.picture, use.seconds(out.size()), record.bytes, record.reduced, {}};
    for (std::size_t r = 0; r < kRegionCount; ++r) p.share[r] = use.share(out.size(), static_cast<Region>(r));
    out.push_back(p);
  }
  return out;
}

nlohmann::json to_json(const PacketEntry& p) {
  nlohmann::json out = {{"offset", p.offset}, {"type", p.type}, {"key", p.key}, {"bytes", p.bytes}};
  out["seconds"] = p.time ? nlohmann::json(seconds_of(*p.time)) : nlohmann::json();
  if (!p.error.empty()) out["error"] = p.error;
  if (p.repaired) out["repaired"] = true;
  return out;
}

void print_packets(const std::string& name, const std::vector<PacketEntry>& packets) {
  std::printf("%s: %zu packets\n", name.c_str(),
              static_cast<std::size_t>(std::ranges::count_if(packets, is_packet)));
  std::printf("  %12s  %-11s  %-3s  %12s  %9s\n", "at byte", "type", "key", "time", "bytes");
  for (const PacketEntry& p : packets) {
    std::array<char, 32> time{"-"};
    if (p.time) std::snprintf(time.data(), time.size(), "%.3f s", seconds_of(*p.time));
    std::printf("  %12llu  %-11s  %-3s  %12s  %9llu%s%s%s\n", static_cast<unsigned long long>(p.offset),
                p.type.c_str(), p.key ? "key" : "", time.data(), static_cast<unsigned long long>(p.bytes),
                p.repaired ? "  one wrong bit set right" : "", p.error.empty() ? "" : "  ", p.error.c_str());
  }
}

/// Lists the packets of a stream, damaged or not.
Result<Outcome> inspect_packets(StreamFile& file, std::span<const std::uint8_t> bytes, bool json) {
  const std::vector<PacketEntry> packets = list_packets(bytes);
  if (std::ranges::none_of(packets, is_packet)) {
    const auto status = file.next();  // reports errors; an empty stream has no packets either
    return status ? fail(ErrorCode::kTruncated, file.name() + ": contains no packets") : fail(status.error());
  }
  if (json) {
    nlohmann::json list = nlohmann::json::array();
    for (const PacketEntry& p : packets) list.push_back(to_json(p));
    std::printf("%s\n", nlohmann::json{{"packets", list}}.dump(1).c_str());
  } else {
    print_packets(file.name(), packets);
  }
  const bool whole = std::ranges::all_of(packets, [](const PacketEntry& p) { return p.error.empty(); });
  return whole ? Outcome::kComplete : Outcome::kLittleLost;
}

Result<Outcome> run_inspect(const InspectArguments& arguments) {
  auto file = StreamFile::open(arguments.input);
  if (!file) return fail(file.error());
  StreamDecoder& decoder = file->decoder();
  const auto bytes = file->read_all();
  if (!bytes) return fail(bytes.error());
  decoder.feed(*bytes);
  if (arguments.packets) return inspect_packets(*file, *bytes, arguments.json);
  decoder.count_motion_bits();
  decoder.record_patterns();
  PatternUse use(decoder);
  Summary s;
  for (;;) {
    auto status = file->next();
    if (!status) return fail(status.error());
    if (*status == DecodeStatus::kEnd) break;
    use.add_picture();
    s.seconds += static_cast<double>(decoder.duration()) / kTicksPerSecond;
  }
  s.bytes = decoder.bytes();
  s.format = decoder.format();
  s.pictures = decoder.pictures();
  s.patterns = patterns_of(decoder, use);
  s.scenes = index_scenes(*bytes);
  s.ended = decoder.announced_pictures().has_value();
  s.face = face_of(decoder.scene()) != nullptr;
  s.steps = decoder.scene().setup.steps;
  s.motion = decoder.motion_bits();
  if (arguments.json)
    std::printf("%s\n", to_json(s).dump(1).c_str());
  else
    print(file->name(), s);
  return Outcome::kComplete;
}

}  // namespace

void add_inspect(CLI::App& app, Run& run) {
  const auto [verb, a] = new_verb<InspectArguments>(
      app, run, "inspect", "Show what a stream contains and the size of each part", run_inspect);
  verb->add_option("INPUT", a.input, "Stream to inspect, or - for standard input")->required();
  verb->add_flag("--packets", a.packets,
                 "List every packet, also of a damaged stream: place, type, time of the first picture that "
                 "it concerns, bytes, and what is wrong; exit code 3: something is");
  verb->add_flag("--json", a.json, "Print JSON");
  verb->footer(kInspectExamples);
}

}  // namespace fbs::cli
