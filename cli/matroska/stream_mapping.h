// A stream as tracks of Matroska, and back. docs/remux.md has the mapping.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cli/matroska/matroska_content.h"
#include "common/result.h"

namespace fbs::cli {

/// Divides a stream into blocks: each has the packets up to the one that releases pictures, at the time of
/// the first of these. A setup packet begins a block, and what follows the last pictures of a scene ends one.
///
/// Opus becomes a track of its own if of_matroska() can put it back where it was; any other sound stays in
/// the video track. What is damaged is kept as it is.
/// @return kNotFbs; kTruncated for a stream without a setup packet; kTooLarge beyond kMaxMatroskaTime; errors
///         of decode_setup()
Result<MatroskaContent> to_matroska(std::span<const std::uint8_t> stream);

/// Whether the packets of the video track include sound.
[[nodiscard]] bool has_sound_inside(const MatroskaVideo& video);

/// The stream that to_matroska() was given. Sound of another writer is put where `encode` would; what is not
/// on the grid of its frames moves it by its skip.
/// @return errors of SoundInterleaver; kUnsupported for sound that no stream can have
Result<std::vector<std::uint8_t>> of_matroska(const MatroskaContent& content);

}  // namespace fbs::cli
