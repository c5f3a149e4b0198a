// fbs doctor: what a report of a bug should say about program and machine.
#include <codec2/version.h>
#include <dav1d/dav1d.h>
#include <draco/core/draco_version.h>
#include <hwy/base.h>
#include <opus/opus.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "bitstream/syntax.h"
#include "cli/command_line/verb.h"
#include "common/workers.h"
#include "decoder/vectors/scalar.h"

namespace fbs::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kDoctorExamples =
    "Examples:\n"
    "  fbs doctor                                      paste this into a bug report\n"
    "  fbs doctor --json | jq .modules                 which parts of the program load, or why not";

struct DoctorArguments {
  bool json = false;
};

/// The value of the first line NAME SEPARATOR VALUE of a file of the system, without quotes.
std::string value_in(const char* file, const std::string& name, char separator) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(name)) continue;
    const std::size_t at = line.find_first_not_of(" \t\"", line.find(separator) + 1);
    if (at == std::string::npos) continue;
    return line.substr(at, line.find_last_not_of(" \"") - at + 1);
  }
  return "unknown";
}

std::string system_name() {
  utsname name{};
  uname(&name);
  return value_in("/etc/os-release", "PRETTY_NAME", '=') + ", " + name.sysname + " " + name.release + " " +
         name.machine;
}

/// "NAME VERSION" lines as an object.
Json libraries_of(const std::string& lines) {
  Json out = Json::object();
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', at), lines.size());
    const std::size_t space = lines.rfind(' ', end - 1);
    out[lines.substr(at, space - at)] = lines.substr(space + 1, end - space - 1);
    at = end + 1;
  }
  return out;
}

Json module_report(const std::string& name) {
  const auto libraries = load_module_function<const char*()>(name, kLibrariesSymbol);
  if (!libraries) return {{"loads", false}, {"reason", libraries.error().text}};
  return {{"loads", true}, {"libraries", libraries_of((*libraries)())}};
}

Json report() {
  Json modules = Json::object();
  for (const char* name : {"fbs_encoder", "fbs_av", "fbs_avfilter", "fbs_image", "fbs_camera", "fbs_matroska",
                           "fbs_model", "fbs_player"})
    modules[name] = module_report(name);
  return {{"fbs", FBS_VERSION},
          {"format", kFormatVersion},
          {"system", system_name()},
          {"processor", value_in("/proc/cpuinfo", "model name", ':')},
          {"threads", core_count()},
          {"kernels", kernel_name()},
          {"libraries",
           {{"Codec 2", CODEC2_VERSION},
            {"dav1d", dav1d_version()},
            {"Draco", draco::kDracoVersion},
            {"Highway", FBS_HIGHWAY_VERSION},
            {"Opus", libraries_of(opus_get_version_string()).front()}}},
          {"modules", modules}};
}

std::string text_of(const Json& libraries) {
  std::string out;
  for (const auto& [name, version] : libraries.items())
    out += (out.empty() ? "" : ", ") + name + " " + version.get<std::string>();
  return out.empty() ? "loads" : out;
}

void print(const Json& report) {
  for (const auto& [name, value] : report.items()) {
    if (name == "modules") continue;
    const std::string text = value.is_string()   ? value.get<std::string>()
                             : value.is_object() ? text_of(value)
                                                 : value.dump();
    std::printf("%-14s%s\n", name.c_str(), text.c_str());
  }
  for (const auto& [name, module] : report["modules"].items()) {
    const std::string text =
        module["loads"] ? text_of(module["libraries"]) : "missing: " + module["reason"].get<std::string>();
    std::printf("%-14s%s\n", name.c_str(), text.c_str());
  }
}

Result<Outcome> run_doctor(const DoctorArguments& arguments) {
  const Json found = report();
  if (arguments.json)
    std::printf("%s\n", found.dump(1).c_str());
  else
    print(found);
  return Outcome::kComplete;
}

}  // namespace

void add_doctor(CLI::App& app, Run& run) {
  const auto [verb, a] = new_verb<DoctorArguments>(
      app, run, "doctor", "Print versions, processor and modules, for bug reports", run_doctor);
  verb->add_flag("--json", a.json, "Print JSON");
  verb->footer(kDoctorExamples);
}

}  // namespace fbs::cli
