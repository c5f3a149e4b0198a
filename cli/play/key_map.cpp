#include "cli/play/key_map.h"

#include <algorithm>
#include <array>

namespace fbs::cli {
namespace {

constexpr std::array kPauseKeys = {Key{"Space"}};
constexpr std::array kForthKeys = {Key{".", 1}, Key{"Right", 1}};
constexpr std::array kBackKeys = {Key{",", -1}, Key{"Left", -1}};
constexpr std::array kSeekForthKeys = {Key{"Up", 5}, Key{"PageUp", 5}};
constexpr std::array kSeekBackKeys = {Key{"Down", -5}, Key{"PageDown", -5}};
constexpr std::array kRestartKeys = {Key{"r"}, Key{"Home"}};
constexpr std::array kLoopKeys = {Key{"l"}};
constexpr std::array kVolumeKeys = {Key{"-", -1}, Key{"+", 1}, Key{"=", 1}, Key{"Shift+=", 1}};
constexpr std::array kMuteKeys = {Key{"v"}};
constexpr std::array kFullScreenKeys = {Key{"f"}, Key{"F11"}};
constexpr std::array kInfoKeys = {Key{"i"}};
constexpr std::array kWireKeys = {Key{"w"}};
constexpr std::array kSnakesKeys = {Key{"s"}};
constexpr std::array kPatternsKeys = {Key{"p"}};
constexpr std::array kSourceKeys = {Key{"c"}};
constexpr std::array kYawKeys = {Key{"Shift+Left", 1}, Key{"Shift+Right", -1}};
constexpr std::array kPitchKeys = {Key{"Shift+Up", -1}, Key{"Shift+Down", 1}};
constexpr std::array kRollKeys = {Key{"Ctrl+Left", -1}, Key{"Ctrl+Right", 1}};
constexpr std::array kBrowsKeys = {Key{"b", 1}, Key{"Shift+b", -1}};
constexpr std::array kMouthKeys = {Key{"m", 1}, Key{"Shift+m", -1}};
constexpr std::array kSmileKeys = {Key{"g", 1}, Key{"Shift+g", -1}};
constexpr std::array kLidsKeys = {Key{"e", 1}, Key{"Shift+e", -1}};
constexpr std::array kResetKeys = {Key{"0"}, Key{"Keypad 0"}, Key{"Backspace"}};
constexpr std::array kPatternKeys = {Key{"1", 1}, Key{"2", 2}, Key{"3", 3}, Key{"4", 4}, Key{"5", 5},
                                     Key{"6", 6}, Key{"7", 7}, Key{"8", 8}, Key{"9", 9}};
constexpr std::array kNextPatternKeys = {Key{"[", -1}, Key{"]", 1}, Key{"Shift+n", -1}, Key{"n", 1}};
constexpr std::array kOwnBlendKeys = {Key{"o"}};
constexpr std::array kHelpKeys = {Key{"h"}, Key{"F1"}};
constexpr std::array kLeaveKeys = {Key{"Escape"}};
constexpr std::array kQuitKeys = {Key{"q"}};

constexpr std::array kLines = {
    KeyLine{Action::kPause, kPauseKeys, "pause or resume"},
    KeyLine{Action::kStep, kForthKeys, "next picture"},
    KeyLine{Action::kStep, kBackKeys, "previous picture"},
    KeyLine{Action::kSeek, kSeekForthKeys, "5 seconds forward"},
    KeyLine{Action::kSeek, kSeekBackKeys, "5 seconds back"},
    KeyLine{Action::kRestart, kRestartKeys, "restart"},
    KeyLine{Action::kLoop, kLoopKeys, "loop on or off"},
    KeyLine{Action::kVolume, kVolumeKeys, "volume down, up"},
    KeyLine{Action::kMute, kMuteKeys, "mute or unmute"},
    KeyLine{Action::kFullScreen, kFullScreenKeys, "full screen"},
    KeyLine{Action::kInfo, kInfoKeys, "time and bitrate"},
    KeyLine{Action::kWire, kWireKeys, "wire-frame"},
    KeyLine{Action::kSnakes, kSnakesKeys, "contours of lips, brows, lids"},
    KeyLine{Action::kPatterns, kPatternsKeys, "patterns in use, and where"},
    KeyLine{Action::kSource, kSourceKeys, "source beside the picture (--source)"},
    KeyLine{Action::kYaw, kYawKeys, "turn the head"},
    KeyLine{Action::kPitch, kPitchKeys, "raise, lower the head"},
    KeyLine{Action::kRoll, kRollKeys, "tilt the head"},
    KeyLine{Action::kBrows, kBrowsKeys, "raise, lower the brows"},
    KeyLine{Action::kMouth, kMouthKeys, "open, shut the mouth"},
    KeyLine{Action::kSmile, kSmileKeys, "smile, frown"},
    KeyLine{Action::kLids, kLidsKeys, "shut, open the eyes"},
    KeyLine{Action::kReset, kResetKeys, "undo all changes to head and face"},
    KeyLine{Action::kPattern, kPatternKeys, "draw from one pattern only"},
    KeyLine{Action::kNextPattern, kNextPatternKeys, "draw from the previous, next pattern"},
    KeyLine{Action::kOwnBlend, kOwnBlendKeys, "back to the stream's patterns"},
    KeyLine{Action::kHelp, kHelpKeys, "this help"},
    KeyLine{Action::kLeave, kLeaveKeys, "leave full screen, or quit"},
    KeyLine{Action::kQuit, kQuitKeys, "quit"},
};

constexpr std::array kMouse = {
    MouseLine{"drag", "turn, raise, lower the head"},
    MouseLine{"drag, right button", "tilt the head"},
    MouseLine{"click at the bottom", "jump to that time"},
};

void add_line(std::string& out, std::string_view left, std::string_view right) {
  constexpr std::size_t kColumn = 24;
  if (!out.empty()) out += '\n';
  out += "  ";
  out += left;
  out.append(kColumn - std::min(kColumn, left.size() + 2) + 1, ' ');
  out += right;
}

}  // namespace

std::string KeyLine::names() const {
  std::string out;
  for (const Key& key : keys) {
    if (!out.empty()) out += ' ';
    out += key.name;
  }
  return out;
}

std::span<const KeyLine> key_lines() {
  return kLines;
}

std::span<const MouseLine> mouse_lines() {
  return kMouse;
}

std::optional<KeyPress> find_key(std::string_view name) {
  for (const KeyLine& line : kLines)
    for (const Key& key : line.keys)
      if (key.name == name) return KeyPress{line.action, key.amount};
  return std::nullopt;
}

std::string key_help() {
  std::string out;
  for (const KeyLine& line : kLines) add_line(out, line.names(), line.text);
  for (const MouseLine& line : kMouse) add_line(out, line.name, line.text);
  return out;
}

}  // namespace fbs::cli
