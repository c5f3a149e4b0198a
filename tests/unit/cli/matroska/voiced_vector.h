// Vectors with sound beside them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "cli/stream/sound_interleaver.h"

namespace fbs::cli {

inline std::vector<std::uint8_t> vector_file(const std::string& name) {
  std::ifstream file(FBS_VECTORS "/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Like `encode`, with Opus frames of 20 ms that contain their number.
/// @param first    number of the first frame
/// @param missing  true for frames to leave empty
template <class Missing>
std::vector<std::uint8_t> voiced(const std::vector<std::uint8_t>& stream, const SoundSetup& setup,
                                 std::int64_t first, const Missing& missing) {
  std::int64_t next = first;
  SoundInterleaver interleaver(setup, [&](std::int64_t before) -> Result<std::vector<SoundGroup>> {
    SoundGroup group{next, {}};
    for (; next * setup.duration - setup.skip < before; ++next)
      group.frames.push_back(missing(next) ? std::vector<std::uint8_t>()
                                           : std::vector<std::uint8_t>{8, static_cast<std::uint8_t>(next),
                                                                       static_cast<std::uint8_t>(next >> 8)});
    if (group.frames.empty()) return std::vector<SoundGroup>();
    return std::vector<SoundGroup>{std::move(group)};
  });
  auto out = interleaver.add(stream);
  EXPECT_TRUE(out) << out.error().text;
  return out.value_or(std::vector<std::uint8_t>());
}

inline constexpr SoundSetup kVoice{SoundCodec::kOpus, 1, 0, 960, 312};

inline std::vector<std::uint8_t> voiced(const std::vector<std::uint8_t>& stream, std::int64_t first = 0) {
  return voiced(stream, kVoice, first, [](std::int64_t) { return false; });
}

}  // namespace fbs::cli
