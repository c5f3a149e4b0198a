// Digest of the sound of a stream: its frames, and how much is heard.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace fbs {

/// Decoded samples are not compared: the codecs' libraries do not guarantee them.
struct SoundDigest {
  std::uint64_t frames = 0;   ///< of sound packets that count, missing ones too if they are said to be
  std::uint64_t samples = 0;  ///< of each channel that are heard, at the rates of the codecs
  std::string md5;            ///< over the bytes of these frames, in order
  friend bool operator==(const SoundDigest&, const SoundDigest&) = default;
};

/// Decodes to the end, continuing after errors.
[[nodiscard]] SoundDigest sound_digest_of(std::span<const std::uint8_t> stream);

/// One line of sound.txt.
struct SoundVector {
  std::string file;
  SoundDigest expected;
};

/// The table sound.txt of a folder: file, frames, samples, MD5. Empty when it cannot be read.
[[nodiscard]] std::vector<SoundVector> read_sound_vectors(const std::string& folder);

}  // namespace fbs
