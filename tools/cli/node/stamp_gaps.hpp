// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace terracut::cli {

/// Tells by the stamps of the clouds that came how many did not: DDS says nothing of what a writer
/// by best effort sent and the network, or a full buffer, lost. Of one writer, whose clouds are
/// evenly apart. One thread.
class StampGaps {
 public:
  /// The next cloud's stamp. How many are missing before it: none as long as too few have come to
  /// tell how far they are apart, after a second or more without any (the sensor was silent), and
  /// where stamps do not grow (a recording that begins again).
  [[nodiscard]] std::uint64_t missing_before(std::int64_t stamp_ns) noexcept;
  /// What came before does not count: there are several writers, say.
  void restart() noexcept { *this = {}; }

 private:
  static constexpr std::size_t kIntervals = 16, kFewest = 4;

  /// As most clouds follow each other: of the intervals between those that came, which are several
  /// periods long where some are missing, one of the short ones.
  [[nodiscard]] std::int64_t period_ns() const noexcept;

  std::array<std::int64_t, kIntervals> intervals_ns_{};
  std::size_t came_ = 0;  ///< Intervals so far.
  std::int64_t before_ns_ = 0;
};

}  // namespace terracut::cli
