// Evaluates all videos of a folder, several at once.
#pragma once

#include <string>
#include <vector>

#include "cli/evaluate/clip_evaluation.h"

namespace fbs::cli {

/// The videos in a folder, chosen by suffix and sorted by name; none where `path` is not a folder, or one of
/// images.
[[nodiscard]] std::vector<std::string> clips_in(const std::string& path);

struct FolderReport {
  std::vector<ClipReport> clips;    ///< in order of name, those that could be evaluated
  std::vector<std::string> failed;  ///< a line for each of the others
};

/// Continues after a clip that fails. Each clip has a folder of its name in the run folder.
/// @param clips  from clips_in()
/// @return kIo when the signal came
Result<FolderReport> evaluate_folder(const EvaluateArguments& arguments,
                                     const std::vector<std::string>& clips, const Tools& tools,
                                     const RunFolder& run, const StopSignal& stop);

}  // namespace fbs::cli
