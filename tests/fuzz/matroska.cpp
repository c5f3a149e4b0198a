// Bytes as a Matroska file: whatever can be read becomes a stream. And bytes as a stream: put into Matroska
// and taken out again, a stream is unchanged, damaged or not.
#include <algorithm>
#include <span>

#include "bitstream/packet.h"
#include "cli/matroska/matroska_reader.h"
#include "cli/matroska/matroska_writer.h"
#include "cli/matroska/stream_mapping.h"
#include "cli/stream/sound_interleaver.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

using fbs::fuzz::Bytes;

constexpr fbs::SoundSetup kVoice{fbs::SoundCodec::kOpus, 1, 0, 960, 312};

/// Opus packets of 20 ms, by their first byte; the rest is not sound.
Bytes with_sound(const Bytes& stream) {
  std::int64_t next = 0;
  fbs::cli::SoundInterleaver interleaver(
      kVoice, [&](std::int64_t before) -> fbs::Result<std::vector<fbs::SoundGroup>> {
        fbs::SoundGroup group{next, {}};
        for (; next * kVoice.duration - kVoice.skip < before && group.frames.size() < 50; ++next)
          group.frames.push_back({8, static_cast<std::uint8_t>(next)});
        if (group.frames.empty()) return std::vector<fbs::SoundGroup>();
        return std::vector<fbs::SoundGroup>{group};
      });
  return interleaver.add(stream).value_or(stream);
}

/// @return nothing for a stream that cannot be put into a file
Bytes file_of(std::span<const std::uint8_t> stream) {
  const auto content = fbs::cli::to_matroska(stream);
  if (!content) {
    require(content.error().code != fbs::ErrorCode::kInternal, "internal error");
    return {};
  }
  const auto file = fbs::cli::write_matroska(*content, "fuzz");
  require(file.has_value(), "a file is not written");
  return *file;
}

void check_way_back(std::span<const std::uint8_t> stream) {
  const Bytes file = file_of(stream);
  if (file.empty()) return;
  const auto read = fbs::cli::read_matroska(file);
  require(read.has_value(), "what was written is not read");
  const auto back = fbs::cli::of_matroska(read->content);
  require(back && std::ranges::equal(*back, stream), "a stream comes back as another");
}

}  // namespace

std::vector<Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  const Bytes voiced = with_sound(stream);
  std::vector<Bytes> seeds{voiced};
  for (const Bytes& s : {stream, voiced})
    if (Bytes file = file_of(s); !file.empty()) seeds.push_back(std::move(file));
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> bytes(data, size);
  check_way_back(bytes);
  const auto read = fbs::cli::read_matroska(bytes);
  if (!read) {
    require(read.error().code != fbs::ErrorCode::kInternal, "internal error");
    return 0;
  }
  if (const auto stream = fbs::cli::of_matroska(read->content)) check_way_back(*stream);
  return 0;
}
