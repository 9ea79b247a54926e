// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rt/threads/nonblocking.hpp"

namespace terracut::measure {

/// Counts durations in buckets whose width grows with the value (HdrHistogram's layout): any
/// percentile is known to two significant digits in fixed memory (about 34 KiB, no allocation).
///
/// Values are nanoseconds in [0, kMax_ns]; values outside count in the first or last bucket, but
/// max_ns() stays exact. Each value below 256 ns has a bucket of its own; above, the width of a
/// bucket is at most 1/128 of its value. One thread writes; others may read only after it has
/// finished.
class LogLinearHistogram {
 public:
  static constexpr std::int64_t kMax_ns = (std::int64_t{1} << 40) - 1;  ///< About 18 minutes.

  /// Counts one duration. Real-time safe: a few instructions.
  void record(std::int64_t value_ns) noexcept TERRACUT_NONBLOCKING;

  /// Returns the value that `percent` of all values, in [0, 100], do not exceed, rounded up to the
  /// limit of its bucket (by at most 1/128), but at most max_ns(). Returns 0 if nothing was
  /// recorded.
  [[nodiscard]] std::int64_t percentile_ns(double percent) const noexcept;

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] std::int64_t min_ns() const noexcept { return count_ == 0 ? 0 : min_ns_; }
  [[nodiscard]] std::int64_t max_ns() const noexcept { return max_ns_; }
  [[nodiscard]] double mean_ns() const noexcept;
  [[nodiscard]] double sum_ns() const noexcept { return sum_ns_; }

  /// Returns how many values are certainly at most `limit_ns`, for cumulative histograms. Counts
  /// only buckets that lie wholly below the limit: so values within 1/128 of the limit may be
  /// missed, but no value above it is counted.
  [[nodiscard]] std::uint64_t count_not_above(std::int64_t limit_ns) const noexcept;

 private:
  static constexpr int kLinearBits = 8;  // 2^8 buckets of width 1, then 2^7 for every doubling
  static constexpr std::size_t kHalf = std::size_t{1} << (kLinearBits - 1);
  static constexpr std::size_t kBuckets = 2 * kHalf + (40 - kLinearBits) * kHalf;

  [[nodiscard]] static std::size_t bucket_of(std::uint64_t value) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] static std::int64_t highest_in(std::size_t bucket) noexcept;

  std::array<std::uint64_t, kBuckets> buckets_{};
  std::uint64_t count_ = 0;
  std::int64_t min_ns_ = INT64_MAX;
  std::int64_t max_ns_ = 0;
  double sum_ns_ = 0;
};

}  // namespace terracut::measure
