// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>

namespace terracut::decode {

/// Estimates, on the host's clock, when packets left a sensor, from their arrival and the device's
/// even stamps. A packet may arrive late, when the network or the machine is busy, but never early.
/// So the least delay seen is assumed for every packet. This delay is forgotten slowly, though
/// faster than clocks drift apart or NTP slews them. One thread.
///
/// Starts again if one of the clocks was set: at a packet more than 20 ms late, or when packets
/// within a short time come more than 2 ms earlier than any before. Earlier results are then not
/// comparable with later ones, or were wrong by more than that: a delay of more than 20 ms looks
/// like a clock that was set.
class HostClock {
 public:
  struct Sent {
    std::int64_t instant_ns = 0;
    bool anew = false;  ///< True if this time is not comparable with those returned before.
  };

  /// `wrap_us` says where the device clock wraps: it counts [0, wrap_us).
  explicit HostClock(std::int64_t wrap_us) noexcept : wrap_us_(wrap_us) {}

  /// Notes that the next packet is the first of a stream.
  void reset() noexcept { known_ = false; }

  /// Returns when a packet left the sensor. Call this for each packet in the stream's order, but
  /// not for packets that arrive out of order.
  [[nodiscard]] Sent sent(std::int64_t device_us, std::int64_t arrived_ns) noexcept {
    std::int64_t step_us = device_us - device_us_;
    if (step_us < 0) step_us += wrap_us_;
    device_us_ = device_us;
    if (!known_) return {start_at(arrived_ns), false};
    if (step_us > kLongestStep_us) return {start_at(arrived_ns), true};
    const std::int64_t step_ns = step_us * 1000;
    const std::int64_t late_ns = arrived_ns - sent_ns_ - step_ns;
    earlier_ns_ = std::max<std::int64_t>(0, earlier_ns_ - step_ns / kDecay) -
                  std::min<std::int64_t>(0, late_ns);
    if (late_ns > kLatest_ns || earlier_ns_ > kEarliest_ns) return {start_at(arrived_ns), true};
    sent_ns_ += step_ns + std::min(late_ns, step_ns / kDrift);
    return {sent_ns_, false};
  }

 private:
  std::int64_t start_at(std::int64_t arrived_ns) noexcept {
    known_ = true;
    earlier_ns_ = 0;
    return sent_ns_ = arrived_ns;
  }

  static constexpr std::int64_t kLatest_ns = 20'000'000;
  static constexpr std::int64_t kEarliest_ns = 2'000'000;
  // A longer step is an outage or a step back.
  static constexpr std::int64_t kLongestStep_us = 100'000'000;
  static constexpr std::int64_t kDrift = 1'000;  // 1000 ppm: NTP slews by 500, quartz drifts by 100
  static constexpr std::int64_t kDecay = 250;    // 4000 ppm, faster than NTP and quartz

  std::int64_t wrap_us_;
  bool known_ = false;
  std::int64_t device_us_ = 0, sent_ns_ = 0;
  /// How much earlier recent packets came than the assumed delay predicts.
  std::int64_t earlier_ns_ = 0;
};

}  // namespace terracut::decode
