// Decodes damaged versions of streams, each with a bounded amount of work: damage STEP MUTATIONS STREAM...
// A stream is cut at every STEP-th byte.
//
// One process per stream decodes its versions in order. Where it crashes or hangs, the version is saved as
// damage_NAME_NUMBER.fbs and another process continues after it. Exit code 1 after any such failure, or if
// decoding took too much memory.
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>

#include "tests/fuzz/bounded_decode.h"
#include "tests/fuzz/damaged_streams.h"
#include "tests/vectors/stream_digest.h"

namespace {

using fbs::fuzz::Bytes;
using fbs::fuzz::DamagedStreams;

constexpr unsigned kMaxSeconds = 60;  // for one version
constexpr int kMaxCrashes = 20;       // per stream: then the rest is left out
// Limit of a process: the pictures of the vectors are small, and damaged ones ask for no more. 8 were seen.
constexpr long kMaxPeakMiB = 64;
#if defined(__SANITIZE_ADDRESS__)          // gcc; build/fuzz does not run this
constexpr bool kMemoryIsMeasured = false;  // the sanitizer's own is much more
#else
constexpr bool kMemoryIsMeasured = true;
#endif

/// What the decoding process writes to memory shared with its parent.
struct Shared {
  std::size_t current = 0;  ///< number of the version being decoded
  std::uint64_t streams = 0, drawn = 0, held = 0, errors = 0, with_pictures = 0;
  std::size_t slowest = 0;
  double slowest_ms = 0;
};

struct Report {
  Shared decoded;
  int crashes = 0;
  long peak_kib = 0;
};

void decode_from(const DamagedStreams& versions, Shared& shared) {
  using Clock = std::chrono::steady_clock;
  for (; shared.current < versions.count(); ++shared.current) {
    const Bytes bytes = versions[shared.current];
    alarm(kMaxSeconds);
    const auto begin = Clock::now();
    const fbs::fuzz::DecodeTally tally = fbs::fuzz::decode_bounded(bytes);
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    ++shared.streams;
    shared.drawn += tally.drawn;
    shared.held += tally.held;
    shared.errors += tally.errors;
    shared.with_pictures += tally.drawn > 0 ? 1 : 0;
    if (ms > shared.slowest_ms) {
      shared.slowest_ms = ms;
      shared.slowest = shared.current;
    }
  }
}

void save(const std::string& name, const DamagedStreams& versions, std::size_t number, int status) {
  const std::string file = "damage_" + name + "_" + std::to_string(number) + ".fbs";
  const Bytes bytes = versions[number];
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const bool killed = WIFSIGNALED(status);
  std::printf("%s: %s: %s %d; saved as %s\n", name.c_str(), versions.what(number).c_str(),
              killed ? "signal" : "exit code", killed ? WTERMSIG(status) : WEXITSTATUS(status), file.c_str());
}

Report decode_all(const std::string& name, const DamagedStreams& versions) {
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) std::abort();
  auto* shared = new (memory) Shared;
  Report report;
  while (report.crashes < kMaxCrashes) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child < 0) std::abort();
    if (child == 0) {
      decode_from(versions, *shared);
      std::_Exit(0);
    }
    int status = 0;
    rusage used{};
    if (wait4(child, &status, 0, &used) != child) std::abort();
    report.peak_kib = std::max(report.peak_kib, used.ru_maxrss);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) break;
    ++report.crashes;
    save(name, versions, shared->current++, status);
  }
  report.decoded = *shared;
  munmap(memory, sizeof(Shared));
  return report;
}

void print(const std::string& name, const Report& r, const std::string& slowest) {
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf("%-26s %9llu %9llu %9llu %9llu %7d %9.1f %9ld  %s\n", name.c_str(), number(r.decoded.streams),
              number(r.decoded.with_pictures), number(r.decoded.drawn), number(r.decoded.errors), r.crashes,
              r.decoded.slowest_ms, r.peak_kib / 1024, slowest.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const std::size_t cut_step = std::stoul(argv[1]), mutations = std::stoul(argv[2]);
  if (cut_step == 0) return 2;
  std::vector<Bytes> streams;
  for (int i = 3; i < argc; ++i) streams.push_back(fbs::read_bytes(argv[i]));
  std::printf("%-26s %9s %9s %9s %9s %7s %9s %9s  %s\n", "stream", "versions", "shown", "pictures", "errors",
              "crashes", "ms", "peak MiB", "slowest");
  Report total;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const std::string name = std::filesystem::path(argv[i + 3]).stem().string();
    const DamagedStreams versions(streams[i], streams, cut_step, mutations);
    const Report r = decode_all(name, versions);
    print(name, r, versions.what(r.decoded.slowest));
    total.crashes += r.crashes;
    total.peak_kib = std::max(total.peak_kib, r.peak_kib);
    total.decoded.streams += r.decoded.streams;
    total.decoded.with_pictures += r.decoded.with_pictures;
    total.decoded.drawn += r.decoded.drawn;
    total.decoded.errors += r.decoded.errors;
    total.decoded.slowest_ms = std::max(total.decoded.slowest_ms, r.decoded.slowest_ms);
  }
  print("total", total, "");
  const bool small = !kMemoryIsMeasured || total.peak_kib <= kMaxPeakMiB * 1024;
  if (!small) std::printf("more than %ld MiB\n", kMaxPeakMiB);
  return total.crashes == 0 && small ? 0 : 1;
}
