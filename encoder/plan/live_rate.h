// Holds a live stream to a rate: limits what may be sent at once, and tells what to spend.
#pragma once

namespace fbs {

/// A leaky bucket. It drains at the rate of the channel; its content waits to be sent.
class LiveRate {
 public:
  /// @param kbps    of the channel, kbit/s, > 0
  /// @param buffer  s, > 0: the longest that anything should wait
  LiveRate(double kbps, double buffer);

  /// The channel has another rate from now on.
  void set(double kbps);

  /// Records bytes sent for pictures that last this long.
  void add(double bytes, double seconds);

  /// Bytes that may be sent now; negative: more than the buffer allows is waiting.
  [[nodiscard]] double room() const { return capacity_ - waiting_; }
  [[nodiscard]] double capacity() const { return capacity_; }
  /// The same for another longest wait, s.
  [[nodiscard]] double room(double seconds) const { return bytes_per_second_ * seconds - waiting_; }

  /// Bits a second to spend now: more than the channel takes while less waits than should, since idle bits
  /// are lost, and fewer while more waits.
  [[nodiscard]] double target() const;

 private:
  double bytes_per_second_;
  double capacity_;        ///< bytes
  double waiting_ = 0;     ///< bytes
  double correction_ = 0;  ///< of the target, as a share of the rate
};

}  // namespace fbs
