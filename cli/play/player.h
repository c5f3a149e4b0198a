// Plays a stream in a window, as keys and mouse say.
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "cli/play/key_map.h"
#include "cli/play/pipe_peek.h"
#include "cli/play/play_arguments.h"
#include "cli/play/playback.h"
#include "cli/play/recording.h"
#include "cli/play/sound/sound_device.h"
#include "cli/play/sound/sound_playback.h"
#include "cli/play/source_track.h"
#include "cli/play/stage.h"
#include "cli/play/window.h"
#include "cli/stream/loss_report.h"
#include "cli/stream/stream_file.h"
#include "decoder/sound/sound_parts.h"

namespace fbs::cli {

/// One stream in one window. Goes on after damage, and says at its end on standard error what was lost.
class Player {
 public:
  /// @param arguments  must outlive the object
  explicit Player(const PlayArguments& arguments) : arguments_(arguments) {}

  /// Opens the stream and all other files, decodes the first picture and opens the window, in this order.
  Result<void> open();
  /// Shows the stream, then its last picture, until the user leaves.
  Result<void> run();

 private:
  Result<void> open_stream();
  /// Finds out what sound there is.
  Result<void> open_sound();
  /// For the sound that there is. Where there is none, pictures go on in silence.
  void open_device();
  /// A decoder begins with every go_to().
  void prepare_decoder();
  Result<void> begin_recording();
  [[nodiscard]] std::uint64_t first_time() const { return ticks(arguments_.from); }

  /// Goes on to the next picture, at the end to the first if the stream is looped, when it is time or when it
  /// is wanted. Nothing happens if the user does something while bytes are waited for.
  Result<void> advance();
  void end_stream();
  /// Keeps sound and pictures together, whatever has been done since the last call.
  void update_sound();
  /// What follows is another time, or waits: nothing of what has been decoded is to be heard.
  void stop_sound();
  /// Up to here what has not come will not come: sound comes before its pictures. 1/kSoundClock s.
  [[nodiscard]] std::int64_t sound_come() const;
  /// Takes the sound of what has been read.
  void read_sound();
  [[nodiscard]] SoundSpan sound_of_picture() const;
  /// Where tests ask for it: number and time of the picture that has been shown, and what is heard then.
  void log_times();
  void take_sound_key(const KeyPress& press);
  /// Wants the picture of that time.
  void go_to(std::uint64_t time);
  /// Wants the picture before or behind.
  void step(int pictures);

  /// Takes what has been done in the window.
  Result<void> take_events();
  void take(const WindowEvent& event);
  void take_key(const KeyPress& press);
  /// Of the keys that change when what is shown.
  void take_playing_key(const KeyPress& press);
  /// Of those that change the window and not the picture.
  void take_window_key(const KeyPress& press);
  /// Of those that change the picture.
  void take_picture_key(const KeyPress& press);
  [[nodiscard]] std::chrono::milliseconds patience() const;

  /// Draws the current picture and shows it; records it if it is another or has changed.
  Result<void> draw();
  Result<void> show();
  [[nodiscard]] Result<cv::Mat> image();
  [[nodiscard]] Size content_of(const cv::Mat& image) const;
  [[nodiscard]] std::vector<Panel> panels() const;
  [[nodiscard]] std::vector<std::string> info() const;
  /// What of the sound is not as in the stream.
  [[nodiscard]] std::string sound_text() const;
  [[nodiscard]] double progress() const;
  [[nodiscard]] StreamDecoder& decoder() { return file_->decoder(); }
  [[nodiscard]] const StreamDecoder& decoder() const { return file_->decoder(); }

  const PlayArguments& arguments_;
  std::optional<StreamFile> file_;
  LossReport losses_;
  std::uint64_t next_ = 0;               ///< time behind the current picture, 1/90000 s
  std::optional<std::uint64_t> length_;  ///< of the stream, 1/90000 s, when it is known
  Playback playback_;
  SoundParts parts_;
  std::size_t parts_read_ = 0;          ///< bytes of the stream
  std::optional<PipePeek> peek_;        ///< if it is no file
  std::optional<SoundPlayback> sound_;  ///< if there is any, and it is wanted
  std::optional<SoundDevice> device_;   ///< of sound_
  std::ofstream times_;                 ///< log_times()
  Stage stage_;
  std::optional<SourceTrack> source_;
  std::optional<Recording> recording_;
  std::optional<Window> window_;

  bool loops_ = false, shows_source_ = false, shows_info_ = true, shows_help_ = false;
  bool quits_ = false;
  bool wanted_ = false;       ///< the next picture, whatever the time
  bool interrupted_ = false;  ///< bytes were waited for when the user did something
  bool reported_ = false;     ///< what was lost
  bool recorded_ = false;     ///< the current picture
  bool drawn_ = true;         ///< the current picture, as it is to be
  bool shown_ = true;         ///< the window shows that
};

}  // namespace fbs::cli
