// Learns what the contexts of motion and blends know before a scene begins:
// bitstream/entropy/trained_contexts.cpp.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bitstream/blend/blend_syntax.h"
#include "bitstream/entropy/bit_counter.h"
#include "bitstream/motion/motion_syntax.h"
#include "bitstream/packet.h"
#include "bitstream/scene/scene_reader.h"

namespace fbs {
namespace {

struct SceneStates {
  Setup setup;
  CodedState rest{};
  std::vector<MotionGroup> motion;
  std::vector<BlendGroup> blends;
};

std::vector<SceneStates> read_scenes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  PacketReader packets(bytes);
  SceneReader reader;
  std::vector<SceneStates> out;
  for (;;) {
    const auto read = packets.next();
    if (!read) throw std::runtime_error(path + ": " + read.error().text);
    if (read->status != ReadStatus::kPacket) return out;
    auto syntax = reader.read(read->packet);
    if (!syntax) throw std::runtime_error(path + ": " + syntax.error().text);
    while (reader.pictures().has_next()) reader.pictures().next();
    if (const auto* const setup = std::get_if<Setup>(&*syntax)) out.push_back({*setup, {}, {}, {}});
    if (out.empty()) continue;
    SceneStates& scene = out[reader.scene() - 1];  // they are numbered from 1
    if (const auto* const patterns = std::get_if<std::vector<ScenePattern>>(&*syntax))
      if (patterns->front().is_first()) scene.rest = patterns->front().coded.state;
    if (auto* const group = std::get_if<MotionGroup>(&*syntax)) scene.motion.push_back(std::move(*group));
    if (auto* const group = std::get_if<BlendGroup>(&*syntax)) scene.blends.push_back(std::move(*group));
    if (auto* const unit = std::get_if<Unit>(&*syntax)) {
      scene.motion.push_back(std::move(unit->motion));
      scene.blends.push_back(std::move(unit->blend));
    }
  }
}

/// All that is learned.
struct Memories {
  MotionMemory motion;
  BlendMemory blends;
};

/// Codes a scene.
/// @param memories  before, and on return after it
/// @return bits
double code(const SceneStates& scene, Memories& memories) {
  if (scene.motion.empty()) return 0;
  BitCounter counter;
  MotionReference reference(scene.setup, scene.rest);
  memories.motion.duration_history = reference.memory.duration_history;
  reference.memory = memories.motion;
  for (const MotionGroup& group : scene.motion) code_body(counter, reference, group, [](std::size_t) {});
  memories.motion = reference.memory;
  for (const BlendGroup& group : scene.blends) {
    code_count(counter, memories.blends, static_cast<std::int32_t>(group.modes.size()));
    code_modes(counter, memories.blends, group);
  }
  return static_cast<double>(counter.bits_x256()) / 256;
}

/// A context in many scenes: the share of zeros varies from one to the next.
class Statistics {
 public:
  void add(const AdaptiveBit& context) {
    const double weight = std::min(context.count(), kMostOfAScene);
    const double zero = context.zero() / 65536.0;
    if (weight > 0) ++scenes_;
    weight_ += weight;
    sum_ += weight * zero;
    squares_ += weight * zero * zero;
  }

  /// The context counts for as many bits as make a beta distribution vary as much.
  [[nodiscard]] TrainedContext trained() const {
    if (weight_ < kLeast) return {};
    const double mean = (sum_ + kDoubt / 2) / (weight_ + kDoubt);
    // Few bits of a scene vary by chance as well.
    const double chance = mean * (1 - mean) * scenes_ / weight_;
    const double variance = std::max(squares_ / weight_ - (sum_ / weight_) * (sum_ / weight_) - chance, 1e-6);
    const double bits = std::min({mean * (1 - mean) / variance, kMostBits, weight_ / 4});
    return {static_cast<std::uint8_t>(std::clamp(std::lround(mean * 256), 1L, 255L)),
            static_cast<std::uint8_t>(bits)};
  }

 private:
  static constexpr int kMostOfAScene = 64;  // bits for which one scene counts
  static constexpr double kLeast = 8;       // fewer bits teach nothing
  static constexpr double kDoubt = 4;       // bits that might have been either
  static constexpr double kMostBits = 24;

  double scenes_ = 0, weight_ = 0, sum_ = 0, squares_ = 0;
};

struct Tables {
  std::vector<TrainedContext> motion, blends;
};

/// Streams by clip: the name of the file up to its first dot.
using Clips = std::map<std::string, std::vector<std::vector<SceneStates>>>;

/// @param without  a clip that is left out
Tables learn(const Clips& clips, const std::string& without) {
  std::vector<Statistics> motion, blends;
  const auto add = [](auto& memory, std::vector<Statistics>& to) {
    std::size_t k = 0;
    for_each_context(memory, [&](const AdaptiveBit& context) {
      if (k == to.size()) to.emplace_back();
      to[k++].add(context);
    });
  };
  for (const auto& [name, streams] : clips)
    for (const auto& scenes : streams)
      for (const SceneStates& scene : scenes) {
        if (name == without) continue;
        Memories memories;
        code(scene, memories);
        add(memories.motion, motion);
        add(memories.blends, blends);
      }
  Tables out;
  for (const Statistics& s : motion) out.motion.push_back(s.trained());
  for (const Statistics& s : blends) out.blends.push_back(s.trained());
  return out;
}

/// Prints what tables that have not seen the clip save.
void cross_validate(const Clips& clips) {
  for (const auto& [name, streams] : clips) {
    const Tables tables = learn(clips, name);
    double before = 0, after = 0;
    for (const auto& scenes : streams)
      for (const SceneStates& scene : scenes) {
        Memories untrained,
            with_tables{trained<MotionMemory>(tables.motion), trained<BlendMemory>(tables.blends)};
        before += code(scene, untrained);
        after += code(scene, with_tables);
      }
    std::cout << name << ": " << before / 8 << " bytes, " << 100 * (after / before - 1) << " %\n";
  }
}

void write(std::ostream& out, const char* name, const std::vector<TrainedContext>& table) {
  out << "constexpr TrainedContext " << name << "[] = {";
  for (std::size_t k = 0; k < table.size(); ++k)
    out << (k % 16 == 0 ? "\n    " : " ") << '{' << int{table[k].zero} << ", " << int{table[k].bits} << "},";
  out << "};\n";
}

int run(const std::string& path, const std::vector<std::string>& streams) {
  Clips clips;
  for (const std::string& stream : streams) {
    const std::string name = std::filesystem::path(stream).filename().string();
    clips[name.substr(0, name.find('.'))].push_back(read_scenes(stream));
  }
  cross_validate(clips);
  const Tables tables = learn(clips, "");
  std::ofstream out(path);
  out << "// Written by training/train_contexts.cpp. SPEC 5.6.\n"
         "#include \"bitstream/entropy/trained_contexts.h\"\n\n"
         "namespace fbs {\nnamespace {\n\n// clang-format off\n";
  write(out, "kMotion", tables.motion);
  write(out, "kBlends", tables.blends);
  out << "// clang-format on\n\n}  // namespace\n";
  for (const auto& [function, table] :
       {std::pair{"trained_motion", "kMotion"}, {"trained_blends", "kBlends"}})
    out << "\nstd::span<const TrainedContext> " << function << "() {\n  return " << table << ";\n}\n";
  out << "\n}  // namespace fbs\n";
  return out ? 0 : 1;
}

}  // namespace
}  // namespace fbs

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: train_contexts OUT.cpp STREAM.fbs...\n"
                 "Learns from the motion and blends of streams. CLIP.*.fbs are of the same clip: prints what "
                 "tables\n"
                 "learned from the others save on each.\n";
    return 2;
  }
  try {
    return fbs::run(argv[1], {argv + 2, argv + argc});
  } catch (const std::exception& e) {
    std::cerr << "train_contexts: " << e.what() << '\n';
    return 1;
  }
}
