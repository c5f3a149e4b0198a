// The keys of the player. One table defines them for the player, for --help and for the help in the window.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fbs::cli {

enum class Action : std::uint8_t {
  kPause,
  kStep,  ///< in pictures; amount -1 or 1
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
  kPattern,      ///< amount: pattern, from 1
  kNextPattern,  ///< amount -1 or 1
  kOwnBlend,
  kHelp,
  kLeave,  ///< full screen, or else the player
  kQuit,
};

/// A key by SDL's name, in small letters, after "Ctrl+" and then "Shift+" where those are held.
struct Key {
  std::string_view name;
  int amount = 0;
};

/// Name of one action, or of two opposite ones.
struct KeyLine {
  Action action;
  std::span<const Key> keys;
  std::string_view text;

  /// Names of the keys, separated by blanks.
  [[nodiscard]] std::string names() const;
};

/// In the order of the help.
[[nodiscard]] std::span<const KeyLine> key_lines();

struct KeyPress {
  Action action;
  int amount;
  friend bool operator==(const KeyPress&, const KeyPress&) = default;
};
/// @param name  as in Key
/// @return nothing for a key without effect
[[nodiscard]] std::optional<KeyPress> find_key(std::string_view name);

/// The mouse in one line per action: gesture, then effect.
struct MouseLine {
  std::string_view name, text;
};
[[nodiscard]] std::span<const MouseLine> mouse_lines();

/// Keys and mouse as a table of two columns, without a final newline.
[[nodiscard]] std::string key_help();

}  // namespace fbs::cli
