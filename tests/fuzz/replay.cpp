// Runs a fuzz target without an engine: TARGET FOLDER [ROUNDS] runs every .fbs file of the folder and ROUNDS
// mutations of each from fixed random seeds; TARGET FILE runs one finding; TARGET --seeds FOLDER OUT writes
// the target's seed inputs as files for a corpus.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "bitstream/packet.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/vectors/stream_digest.h"

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

/// The stream itself, or the payloads of the packets that the target takes.
void add_seeds(const Bytes& stream, std::vector<Bytes>& seeds) {
  if (kSeedPacket == 0) {
    seeds.push_back(stream);
    return;
  }
  fbs::PacketReader reader;
  reader.feed(stream);
  reader.close();
  for (auto read = reader.next(); read && read->status == fbs::ReadStatus::kPacket; read = reader.next())
    if (static_cast<std::uint8_t>(read->packet.type) == kSeedPacket)
      seeds.emplace_back(read->packet.payload.begin(), read->packet.payload.end());
}

std::vector<Bytes> seeds_of(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".fbs") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Bytes> seeds;
  for (const fs::path& file : files) add_seeds(fbs::read_bytes(file.string()), seeds);
  return seeds;
}

void mutate(Bytes& bytes, std::mt19937& random) {
  for (unsigned n = 1 + random() % 4; n > 0 && !bytes.empty(); --n) {
    const std::size_t at = random() % bytes.size();
    const auto there = bytes.begin() + at;
    switch (random() % 6) {
      case 0:
        bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ 1U << random() % 8);
        break;
      case 1:
        bytes[at] = static_cast<std::uint8_t>(random());
        break;
      case 2:
        bytes[at] = random() % 2 == 0 ? 0x00 : 0xFF;
        break;
      case 3:
        bytes.insert(there, static_cast<std::uint8_t>(random()));
        break;
      case 4:
        bytes.erase(there, there + std::min<std::size_t>(1 + random() % 4, bytes.size() - at));
        break;
      default: {
        const std::size_t from = random() % bytes.size(),
                          count = std::min<std::size_t>(random() % 16, bytes.size() - std::max(from, at));
        std::copy_n(bytes.begin() + from, count, there);
        break;
      }
    }
  }
  if (random() % 12 == 0) bytes.resize(random() % (bytes.size() + 1));
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
  if (argc == 4 && std::string(argv[1]) == "--seeds") return write_seeds(seeds_of(argv[2]), argv[3]);
  if (argc != 2 && argc != 3) return 2;
  if (fs::is_regular_file(argv[1])) {  // one finding
    run(fbs::read_bytes(argv[1]));
    return 0;
  }
  const auto seeds = seeds_of(argv[1]);
  const int rounds = argc == 3 ? std::stoi(argv[2]) : 0;
  std::mt19937 random(1);
  run({});
  for (const Bytes& seed : seeds) {
    run(seed);
    for (int i = 0; i < rounds; ++i) {
      Bytes changed = seed;
      mutate(changed, random);
      run(changed);
    }
  }
  std::cout << seeds.size() << " seeds, " << rounds << " mutations of each\n";
  return seeds.empty() ? 1 : 0;
}
