// Holds a live stream to a rate: limits what may be sent at once, and prices bits.
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
  /// The same for another longest wait, s.
  [[nodiscard]] double room(double seconds) const { return bytes_per_second_ * seconds - waiting_; }

  /// How much more a bit is worth than at the start: rises while more is sent than the channel takes, and
  /// falls while it is idle. 1/kMaxFactor..kMaxFactor
  [[nodiscard]] double price() const;

  static constexpr double kMaxFactor = 4096;

 private:
  double bytes_per_second_;
  double capacity_;     ///< bytes
  double waiting_ = 0;  ///< bytes
  double log_price_ = 0;
};

}  // namespace fbs
