// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace terracut::status {

/// Measures the time that the hypervisor took from this machine while a frame was processed, for
/// the thread that judges frames. Threads with a deadline do not ask for it, because the kernel may
/// take a millisecond to answer (rt/measure/stolen_time.hpp). The time is read a few times a second
/// and after a missed deadline, so a frame may be charged with time taken up to a quarter of a
/// second before or after it. One thread; reads no clock.
///
/// `Stolen` is like measure::StolenTime.
template <class Stolen>
class StolenTimeShare {
 public:
  explicit StolenTimeShare(Stolen stolen) noexcept : stolen_(std::move(stolen)) {}

  /// Reads the stolen time if it is due; may be called at any rate.
  void work_round(std::int64_t now_ns) noexcept {
    const bool clock_was_set_back = now_ns < newest().at_ns;
    if (clock_was_set_back || now_ns - newest().at_ns >= kEvery_ns) read(now_ns);
  }
  /// Returns the time that was taken from `begin_ns` to now.
  [[nodiscard]] std::int64_t since(std::int64_t begin_ns, std::int64_t now_ns) noexcept {
    if (newest().at_ns < now_ns) read(now_ns);
    std::int64_t before_ns = newest().stolen_ns;
    for (std::size_t age = 0; age < readings_.size(); ++age) {
      const Reading& reading = readings_[(next_ + readings_.size() - 1 - age) % readings_.size()];
      if (reading.at_ns == 0) break;
      before_ns = reading.stolen_ns;
      if (reading.at_ns <= begin_ns) break;
    }
    return newest().stolen_ns - before_ns;
  }

 private:
  static constexpr std::int64_t kEvery_ns = 250'000'000;

  struct Reading {
    std::int64_t at_ns = 0, stolen_ns = 0;
  };
  [[nodiscard]] const Reading& newest() const noexcept {
    return readings_[(next_ + readings_.size() - 1) % readings_.size()];
  }
  void read(std::int64_t now_ns) noexcept {
    const std::optional<std::int64_t> stolen_ns = stolen_.read_ns();
    readings_[next_] = {now_ns, stolen_ns.value_or(newest().stolen_ns)};
    next_ = (next_ + 1) % readings_.size();
  }

  Stolen stolen_;
  std::array<Reading, 8> readings_{};
  std::size_t next_ = 0;
};

}  // namespace terracut::status
