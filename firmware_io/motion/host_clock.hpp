// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>

namespace terracut::firmware_io {

/// When packets left a sensor, on the host's clock, from the stamps of their arrival and the even
/// stamps of the device. A packet may arrive late, by as much as the network and the machine were
/// busy, but never early: the least delay seen is taken for that of all, and let go again slowly,
/// faster than clocks drift apart. One thread.
class HostClock {
 public:
  /// `wrap_us`: the device clock counts [0, wrap_us).
  explicit HostClock(std::int64_t wrap_us) noexcept : wrap_us_(wrap_us) {}

  void forget() noexcept { known_ = false; }

  /// For each packet in the order of the stream; not for one that was overtaken.
  [[nodiscard]] std::int64_t sent_ns(std::int64_t device_us, std::int64_t arrived_ns) noexcept {
    std::int64_t step_us = device_us - device_us_;
    if (step_us < 0) step_us += wrap_us_;
    device_us_ = device_us;
    if (!known_ || step_us > kLongestStep_us) return start_at(arrived_ns);
    const std::int64_t step_ns = step_us * 1000;
    const std::int64_t late_ns = arrived_ns - sent_ns_ - step_ns;
    if (late_ns > kLatest_ns || late_ns < -kLatest_ns) return start_at(arrived_ns);
    sent_ns_ += step_ns + std::min(late_ns, step_ns / kDrift);
    return sent_ns_;
  }

 private:
  std::int64_t start_at(std::int64_t arrived_ns) noexcept {
    known_ = true;
    return sent_ns_ = arrived_ns;
  }

  static constexpr std::int64_t kLatest_ns = 20'000'000;        // more: a clock was set
  static constexpr std::int64_t kLongestStep_us = 100'000'000;  // more: outages, backward steps
  static constexpr std::int64_t kDrift = 2'000;                 // 500 ppm

  std::int64_t wrap_us_;
  bool known_ = false;
  std::int64_t device_us_ = 0, sent_ns_ = 0;
};

}  // namespace terracut::firmware_io
