// The keys of the player. One table says what each does, in the player, in --help and in the help in the
// window.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fbs::cli {

enum class Action : std::uint8_t {
  kPause,
  kStep,  ///< pictures; amount -1 or 1
  kSeek,  ///< amount in seconds
  kRestart,
  kLoop,
  kVolume,  ///< amount -1 or 1
  kMute,
  kFullScreen,
  kInfo,
  kWire,
  kSnakes,
  kPatterns,
  kSource,
  kYaw,  ///< this and the following: amount in steps of the part
  kPitch,
  kRoll,
  kBrows,
  kMouth,
  kSmile,
  kLids,
  kReset,
  kPattern,      ///< amount: from 1
  kNextPattern,  ///< amount -1 or 1
  kOwnBlend,
  kHelp,
  kLeave,  ///< full screen, or else the player
  kQuit,
};

/// A key by SDL's name for it, letters small, with "Ctrl+" and then "Shift+" before it where those are held.
struct Key {
  std::string_view name;
  int amount = 0;
};

/// What one action, or two opposite ones, are called.
struct KeyLine {
  Action action;
  std::span<const Key> keys;
  std::string_view text;

  /// Names of the keys, with blanks between them.
  [[nodiscard]] std::string names() const;
};

/// In the order in which help lists them.
[[nodiscard]] std::span<const KeyLine> key_lines();

struct KeyPress {
  Action action;
  int amount;
  friend bool operator==(const KeyPress&, const KeyPress&) = default;
};
/// @param name  as in Key
/// @return nothing for a key that does nothing
[[nodiscard]] std::optional<KeyPress> find_key(std::string_view name);

/// What the mouse does, a line each, first what is done with it.
struct MouseLine {
  std::string_view name, text;
};
[[nodiscard]] std::span<const MouseLine> mouse_lines();

/// Keys and mouse as a table of two columns, without a newline at its end.
[[nodiscard]] std::string key_help();

}  // namespace fbs::cli
