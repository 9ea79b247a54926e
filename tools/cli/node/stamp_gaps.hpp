// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace terracut::cli {

/// Counts the clouds missing between received ones by their stamps: DDS does not report clouds of a
/// best-effort writer that the network, or a full buffer, has lost. Needs a single writer with
/// evenly spaced clouds. One thread.
class StampGaps {
 public:
  /// Takes the next cloud's stamp and returns how many clouds are missing before it. Returns 0
  /// while the interval is unknown, after a second or more without clouds (the sensor was silent),
  /// and if stamps do not grow (a recording that starts over).
  [[nodiscard]] std::uint64_t missing_before(std::int64_t stamp_ns) noexcept;
  /// Forgets earlier clouds, for instance when there are several writers.
  void restart() noexcept { *this = {}; }

 private:
  static constexpr std::size_t kIntervals = 16, kFewest = 4;

  /// Estimates the period as the lower quartile of the latest intervals, because some intervals are
  /// gaps.
  [[nodiscard]] std::int64_t period_ns() const noexcept;

  std::array<std::int64_t, kIntervals> intervals_ns_{};
  std::size_t came_ = 0;  ///< Number of intervals so far.
  std::int64_t before_ns_ = 0;
};

}  // namespace terracut::cli
