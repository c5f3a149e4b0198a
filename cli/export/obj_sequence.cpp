#include "cli/export/obj_sequence.h"

#include <filesystem>
#include <span>
#include <vector>

#include "cli/export/head_looks.h"
#include "cli/files/atomic_file.h"
#include "cli/files/output_check.h"
#include "decoder/export/obj_model.h"

namespace fbs::cli {
namespace {

/// Files that appear together.
class FileSet {
 public:
  Result<void> add(const std::string& name, std::span<const std::uint8_t> bytes) {
    auto file = AtomicFile::create(name);
    if (!file) return fail(file.error());
    if (file->replaced_leftover() && files_.empty()) print_replaced_leftover(name);
    if (auto written = file->write(bytes); !written) return written;
    if (auto closed = file->close(); !closed) return closed;
    if (!files_.empty()) file->unlock();  // the first keeps other processes away from the whole set
    files_.push_back(std::move(*file));
    return {};
  }
  Result<void> add(const std::string& name, const std::string& text) {
    return add(name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  Result<void> commit() {
    for (AtomicFile& file : files_)
      if (auto committed = file.commit(); !committed) return committed;
    return {};
  }

 private:
  std::vector<AtomicFile> files_;
};

/// The name without number and suffix: "folder/head" of "folder/head_%05d.obj".
std::string stem_of(const NumberPattern& pattern) {
  std::string stem = pattern.before;
  while (!stem.empty() && (stem.back() == '_' || stem.back() == '-' || stem.back() == '.')) stem.pop_back();
  return stem.empty() || stem.back() == '/' ? stem + "head" : stem;
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

std::string numbered(const std::string& stem, std::size_t head) {
  return head == 0 ? stem : stem + "_" + std::to_string(head);
}

/// Materials and textures.
Result<void> add_looks(FileSet& files, const HeadRecording& recording, const std::string& stem) {
  const auto looks = make_head_looks(recording);
  if (!looks) return fail(looks.error());
  std::string materials;
  for (std::size_t h = 0; h < looks->size(); ++h) {
    const std::string texture = numbered(stem, h) + ".png";
    materials += mtl_of((*looks)[h], file_name(texture), numbered("head", h));
    if (auto added = files.add(texture, (*looks)[h].png); !added) return added;
  }
  return files.add(stem + ".mtl", materials);
}

/// The states of all heads in the order of their times.
class StateCursor {
 public:
  explicit StateCursor(const HeadRecording& recording)
      : recording_(recording), next_(recording.heads().size()) {}

  /// @return index of the head with a state at `time`; heads().size(): none
  std::size_t at(std::uint64_t time, const State*& state) {
    for (std::size_t h = 0; h < next_.size(); ++h) {
      const auto& states = recording_.heads()[h].states;
      if (next_[h] == states.size() || states[next_[h]].time != time) continue;
      state = &states[next_[h]++].state;
      return h;
    }
    return next_.size();
  }

 private:
  const HeadRecording& recording_;
  std::vector<std::size_t> next_;
};

}  // namespace

Result<NumberPattern> obj_pattern(const std::string& output) {
  auto pattern = parse_number_pattern(output);
  if (!pattern)
    return fail(ErrorCode::kUnsupported,
                "cannot write " + output + ": the name needs one number, as head_%05d.obj has");
  return *pattern;
}

Result<void> write_obj_sequence(const HeadRecording& recording, const NumberPattern& pattern) {
  const std::string stem = stem_of(pattern);
  FileSet files;
  StateCursor cursor(recording);
  std::int64_t number = 0;
  for (const std::uint64_t time : recording.times()) {
    const State* state = nullptr;
    const std::size_t h = cursor.at(time, state);
    const std::string text = state == nullptr
                                 ? obj_of_nobody()
                                 : obj_of(recording.heads()[h], *state, recording.first_scale(),
                                          recording.format(), file_name(stem + ".mtl"), numbered("head", h));
    if (auto added = files.add(pattern.name(++number), text); !added) return added;
  }
  if (auto added = add_looks(files, recording, stem); !added) return added;
  return files.commit();
}

}  // namespace fbs::cli
