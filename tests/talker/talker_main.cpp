// talker: renders a talking head with exact truth. See README.md.
#include <fstream>
#include <iostream>

#include "tests/talker/talker_files.h"
#include "tests/talker/talker_options.h"

namespace {

using namespace fbs::talker;

/// Writes one file with `write`; reports failure on standard error.
template <class Write>
bool write_file(const std::string& path, Write write) {
  std::ofstream out(path, std::ios::binary);
  if (out) write(out);
  out.close();
  if (out) return true;
  std::cerr << "talker: cannot write " << path << '\n';
  return false;
}

void write_video(std::ostream& out, const Talker& talker) {
  write_y4m_header(out, talker.settings());
  for (int frame = 0; frame < talker.settings().frame_count && out; ++frame) {
    write_y4m_frame(out, talker.picture(frame));
  }
  out.flush();
}

bool write_all(const Options& options) {
  const Talker talker(options.settings);
  if (!options.truth.empty() && !write_file(options.truth, [&](std::ostream& out) {
        write_truth_header(out);
        for (int frame = 0; frame < options.settings.frame_count; ++frame)
          write_truth_line(out, talker, frame);
      })) {
    return false;
  }
  if (!options.marks.empty() &&
      !write_file(options.marks, [&](std::ostream& out) { write_marks(out, talker, 0); })) {
    return false;
  }
  if (options.video != "-")
    return write_file(options.video, [&](std::ostream& out) { write_video(out, talker); });
  write_video(std::cout, talker);
  if (std::cout) return true;
  std::cerr << "talker: cannot write to standard output\n";
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  std::string complaint;
  const auto options = parse_options({argv + 1, static_cast<std::size_t>(argc - 1)}, complaint);
  if (!options) {
    std::cerr << "talker: " << complaint << '\n' << kUsage;
    return 2;
  }
  if (options->help) {
    std::cout << kUsage;
    return 0;
  }
  return write_all(*options) ? 0 : 1;
}
