#include "cli/program/report.h"

#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace fbs {
namespace {

int descriptor_of_environment() {
  const char* const text = std::getenv("FBS_REPORT_FD");  // NOLINT(concurrency-mt-unsafe): nothing sets it
  if (text == nullptr) return -1;
  const std::string_view digits(text);
  int number = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc{} && end == digits.data() + digits.size() ? number : -1;
}

int descriptor() {
  static const int number = descriptor_of_environment();
  return number;
}

/// In one piece, so that lines of several threads do not mix. Who does not listen any more ends us with
/// SIGPIPE.
void report(const std::string& line) {
  if (!reports()) return;
  [[maybe_unused]] const ssize_t written = write(descriptor(), line.data(), line.size());
}

const char* name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
    case ErrorCode::kTooFewFaces:  // of the option --face
      return "argument";
    case ErrorCode::kNotFbs:
      return "not_fbs";
    case ErrorCode::kTruncated:
      return "truncated";
    case ErrorCode::kInvalidStream:
      return "damaged";
    case ErrorCode::kUnsupported:
      return "unsupported";
    case ErrorCode::kTooLarge:
      return "too_large";
    case ErrorCode::kNoFace:
      return "no_face";
    case ErrorCode::kIo:
      return "io";
    case ErrorCode::kDegenerateInput:
    case ErrorCode::kInternal:
      return "internal";
  }
  return "internal";
}

}  // namespace

bool reports() {
  return descriptor() >= 0;
}

void report_progress(const std::string& label, std::int64_t done, std::optional<std::int64_t> total) {
  report("progress " + std::to_string(done) + ' ' + (total ? std::to_string(*total) : "-") + ' ' + label +
         '\n');
}

void report_error(ErrorCode code) {
  report(std::string("error ") + name_of(code) + '\n');
}

void report_no_memory() {
  report("error no_memory\n");
}

}  // namespace fbs
