// Maps a stream to tracks of Matroska, and back: docs/remux.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cli/matroska/matroska_content.h"
#include "common/result.h"

namespace fbs::cli {

/// Divides a stream into blocks: each ends with the packet that releases pictures, and has the time of the
/// first of these. A setup packet begins a block; packets after the last pictures of a scene belong to its
/// last one.
///
/// Opus becomes a track of its own if of_matroska() can put it back exactly; any other sound stays in the
/// video track. Damaged parts are kept unchanged.
/// @return kNotFbs; kTruncated for a stream without a setup packet; kTooLarge beyond kMaxMatroskaTime; errors
///         of decode_setup()
Result<MatroskaContent> to_matroska(std::span<const std::uint8_t> stream);

/// Whether the packets of the video track include sound.
[[nodiscard]] bool has_sound_inside(const MatroskaVideo& video);

/// The stream that to_matroska() was given. Another writer's sound is placed where `encode` would place it;
/// the skip absorbs its offset from the grid of frames.
/// @return errors of SoundInterleaver; kUnsupported for sound that no stream can have
Result<std::vector<std::uint8_t>> of_matroska(const MatroskaContent& content);

}  // namespace fbs::cli
