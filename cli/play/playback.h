// Decides when each picture of a stream is shown. Independent of window and decoder.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace fbs::cli {

/// Ties the time of a stream to a monotonic clock. Pictures decoded too late are not to be drawn; a stream
/// that cannot be decoded as fast as it plays is slowed down instead, and so is one that waits for its bytes.
class Playback {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  /// Takes the next decoded picture.
  /// @param begin     in the stream, 1/90000 s
  /// @param duration  1/90000 s
  void take(std::uint64_t begin, std::uint32_t duration, Time now);
  /// Follows another clock, the sound's: it gives the present time in the stream. Until the next jump or
  /// pause pictures keep to it, however late they are; call repeatedly.
  /// @param stream  1/90000 s
  void follow(std::uint64_t stream, Time now);
  /// The next picture does not follow the last and is shown at once.
  void jump();
  /// There is no picture after the last. take() resumes.
  void end() { ended_ = true; }

  void pause(bool paused, Time now);
  [[nodiscard]] bool paused() const { return paused_; }
  [[nodiscard]] bool ended() const { return ended_; }

  /// Whether the picture after the last one taken is due.
  [[nodiscard]] bool is_due(Time now) const {
    return is_running() && until_due(now) <= Clock::duration::zero();
  }
  /// Time until it is due; not negative. Only while is_running().
  [[nodiscard]] Clock::duration until_due(Time now) const;
  /// Neither paused nor ended.
  [[nodiscard]] bool is_running() const { return !paused_ && !ended_; }

  /// Whether the picture taken last need not be drawn: its time is over. One is drawn after kMostSkipped,
  /// however late.
  [[nodiscard]] bool is_late(Time now) const;
  /// Records that the picture has been drawn.
  void drawn(Time now) { drawn_ = now; }

  static constexpr std::chrono::milliseconds kMostSkipped{200};  ///< between two drawn pictures
  static constexpr std::chrono::milliseconds kMostLate{500};     ///< beyond that the stream is slowed down

 private:
  struct Anchor {
    std::uint64_t stream;  ///< 1/90000 s
    Time wall;
  };
  [[nodiscard]] Time wall_time(std::uint64_t stream) const;

  std::optional<Anchor> anchor_;
  std::uint64_t begin_ = 0, end_ = 0;  ///< of the picture taken last, 1/90000 s
  std::optional<Time> drawn_;
  bool paused_ = false, ended_ = false;
  bool follows_ = false;  ///< another clock
};

/// The time in a stream in players' notation: "1:02:03.45" or "2:03.45".
[[nodiscard]] std::string clock_text(std::uint64_t ticks);

}  // namespace fbs::cli
