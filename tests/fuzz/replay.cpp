// Runs a fuzz target without an engine: TARGET FOLDER [ROUNDS] runs every .fbs file of the folder and ROUNDS
// mutations of each from fixed random seeds; TARGET FILE runs one finding; TARGET --seeds FOLDER OUT writes
// the target's seed inputs as files for a corpus.
#include "tests/fuzz/replay.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include "tests/fuzz/byte_mutator.h"
#include "tests/vectors/stream_digest.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room) {
  static fbs::fuzz::Random random(2);  // libFuzzer's has its own state too
  fbs::fuzz::Bytes bytes(data, data + size);
  fbs::fuzz::mutate_bytes(bytes, random);
  bytes.resize(std::min(bytes.size(), room));
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

namespace {

namespace fs = std::filesystem;
using fbs::fuzz::Bytes;
using fbs::fuzz::Random;

constexpr std::size_t kRoom = std::size_t{1} << 16;  // bytes, of a mutated input

std::vector<Bytes> seeds_of_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".fbs") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Bytes> seeds;
  for (const fs::path& file : files) {
    const auto found = fbs::fuzz::seeds_of(fbs::read_bytes(file.string()));
    seeds.insert(seeds.end(), found.begin(), found.end());
  }
  return seeds;
}

/// By the target's own mutators if it has them.
Bytes mutated(const Bytes& seed, const std::vector<Bytes>& seeds, Random& random) {
  if (LLVMFuzzerCustomMutator == nullptr) {
    Bytes out = seed;
    fbs::fuzz::mutate_bytes(out, random);
    return out;
  }
  Bytes out(std::max(seed.size(), kRoom));
  if (random() % 4 == 0) {
    const Bytes& other = seeds[random() % seeds.size()];
    out.resize(LLVMFuzzerCustomCrossOver(seed.data(), seed.size(), other.data(), other.size(), out.data(),
                                         out.size(), static_cast<unsigned>(random())));
  } else {
    std::copy(seed.begin(), seed.end(), out.begin());
    out.resize(LLVMFuzzerCustomMutator(out.data(), seed.size(), out.size(), static_cast<unsigned>(random())));
  }
  return out;
}

/// Runs an exactly sized copy, so that a sanitizer detects a read one byte past the end.
void run(const Bytes& bytes) {
  const std::unique_ptr<std::uint8_t[]> exact(new std::uint8_t[bytes.size()]);
  std::copy(bytes.begin(), bytes.end(), exact.get());
  LLVMFuzzerTestOneInput(exact.get(), bytes.size());
}

int write_seeds(const std::vector<Bytes>& seeds, const fs::path& out) {
  fs::create_directories(out);
  for (std::size_t i = 0; i < seeds.size(); ++i)
    std::ofstream(out / ("seed_" + std::to_string(i)), std::ios::binary)
        .write(reinterpret_cast<const char*>(seeds[i].data()), static_cast<std::streamsize>(seeds[i].size()));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::string(argv[1]) == "--seeds") return write_seeds(seeds_of_folder(argv[2]), argv[3]);
  if (argc != 2 && argc != 3) return 2;
  if (fs::is_regular_file(argv[1])) {  // one finding
    run(fbs::read_bytes(argv[1]));
    return 0;
  }
  const auto seeds = seeds_of_folder(argv[1]);
  const int rounds = argc == 3 ? std::stoi(argv[2]) : 0;
  Random random(1);
  run({});
  for (const Bytes& seed : seeds) {
    run(seed);
    for (int i = 0; i < rounds; ++i) run(mutated(seed, seeds, random));
  }
  std::cout << seeds.size() << " seeds, " << rounds << " mutations of each\n";
  return seeds.empty() ? 1 : 0;
}
