// Plays a stream in a window, controlled by keys and mouse.
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

/// One stream in one window. Continues after damage, and reports losses on standard error at the end.
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
  /// Looks for sound.
  Result<void> open_sound();
  /// Opens the sound device; without one, pictures continue in silence.
  void open_device();
  /// Creates the decoder; every go_to() needs a new one.
  void prepare_decoder();
  Result<void> begin_recording();
  [[nodiscard]] std::uint64_t first_time() const { return ticks(arguments_.from); }

  /// Advances to the next picture when it is due or wanted; at the end of a looped stream to the first. Does
  /// nothing if the user acts while it waits for bytes.
  Result<void> advance();
  void end_stream();
  /// Keeps sound and pictures together, whatever has happened since the last call.
  void update_sound();
  /// Stops the sound before a jump or a wait: nothing decoded so far is to be heard.
  void stop_sound();
  /// End of the sound that has arrived or is lost, since sound comes before its pictures. 1/kSoundClock s.
  [[nodiscard]] std::int64_t sound_come() const;
  /// Takes the sound from the bytes read.
  void read_sound();
  [[nodiscard]] SoundSpan sound_of_picture() const;
  /// For tests that ask for it: logs number and time of the picture shown, and the sound heard with it.
  void log_times();
  void take_sound_key(const KeyPress& press);
  /// Requests the picture of a time.
  void go_to(std::uint64_t time);
  /// Requests the picture before or after.
  void step(int pictures);

  /// Handles what the user has done in the window.
  Result<void> take_events();
  void take(const WindowEvent& event);
  void take_key(const KeyPress& press);
  /// Handles keys that control playback.
  void take_playing_key(const KeyPress& press);
  /// Handles keys that change the window but not the picture.
  void take_window_key(const KeyPress& press);
  /// Handles keys that change the picture.
  void take_picture_key(const KeyPress& press);
  [[nodiscard]] std::chrono::milliseconds patience() const;

  /// Draws the current picture and shows it; records it if it is new or has changed.
  Result<void> draw();
  Result<void> show();
  [[nodiscard]] Result<cv::Mat> image();
  [[nodiscard]] Size content_of(const cv::Mat& image) const;
  [[nodiscard]] std::vector<Panel> panels() const;
  [[nodiscard]] std::vector<std::string> info() const;
  [[nodiscard]] double progress() const;
  [[nodiscard]] StreamDecoder& decoder() { return file_->decoder(); }
  [[nodiscard]] const StreamDecoder& decoder() const { return file_->decoder(); }

  const PlayArguments& arguments_;
  std::optional<StreamFile> file_;
  LossReport losses_;
  std::uint64_t next_ = 0;               ///< end time of the current picture, 1/90000 s
  std::optional<std::uint64_t> length_;  ///< of the stream, 1/90000 s, once known
  Playback playback_;
  SoundParts parts_;
  std::size_t parts_read_ = 0;          ///< bytes of the stream
  std::optional<PipePeek> peek_;        ///< unless it is a file
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
  bool interrupted_ = false;  ///< the user acted while bytes were waited for
  bool reported_ = false;     ///< losses have been reported
  bool recorded_ = false;     ///< the current picture is recorded
  bool drawn_ = true;         ///< the current picture is drawn in its present form
  bool shown_ = true;         ///< the window shows it
};

}  // namespace fbs::cli
