#include "cli/standard_output.h"

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace fbs::cli {

Result<void> flush_standard_output() {
  if (std::fflush(stdout) != 0)
    return fail(ErrorCode::kIo, "cannot write standard output: " + std::generic_category().message(errno));
  if (std::ferror(stdout) != 0)  // an earlier write, whose reason is not known any more
    return fail(ErrorCode::kIo, "cannot write standard output");
  return {};
}

}  // namespace fbs::cli
