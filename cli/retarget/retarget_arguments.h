// Arguments of `fbs retarget`.
#pragma once

#include <optional>
#include <string>

namespace fbs::cli {

struct RetargetArguments {
  std::string motion;          ///< stream
  std::string face;            ///< stream, or a picture
  std::string output;          ///< stream
  std::string wire_frame;      ///< glTF; empty: the face's
  std::optional<int> quality;  ///< of the picture, 0..100; nothing: kPictureQuality
  bool no_sound = false;       ///< leave out the sound of the motion
  bool quiet = false;
};

inline constexpr int kPictureQuality = 70;                          ///< high: it is sent once
inline constexpr const char* kRetargetSymbol = "fbs_run_retarget";  ///< in the encoder's module

}  // namespace fbs::cli
