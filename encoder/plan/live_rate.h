// Holds a live stream to a rate: how much may be sent at once, and how dear a bit is meanwhile.
#pragma once

namespace fbs {

/// A leaky bucket. It drains at the rate of the channel; what is in it waits to be sent.
class LiveRate {
 public:
  /// @param kbps    of the channel, kbit/s, > 0
  /// @param buffer  s, > 0: nothing should wait longer
  LiveRate(double kbps, double buffer);

  /// So many bytes have been sent for pictures that last so long.
  void add(double bytes, double seconds);

  /// Bytes that may be sent now; negative: more wait than should.
  [[nodiscard]] double room() const { return capacity_ - waiting_; }

  /// By how much more a bit is worth than at the start: rises while more is sent than the channel takes, and
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
