// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/measure/log_linear_histogram.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace terracut::measure {

std::size_t LogLinearHistogram::bucket_of(std::uint64_t value) noexcept TERRACUT_NONBLOCKING {
  if (value < 2 * kHalf) return static_cast<std::size_t>(value);
  // The leading kLinearBits bits of the value: value >> shift lies in [kHalf, 2 kHalf).
  const auto shift = static_cast<std::size_t>(std::bit_width(value) - kLinearBits);
  return shift * kHalf + static_cast<std::size_t>(value >> shift);
}

std::int64_t LogLinearHistogram::highest_in(std::size_t bucket) noexcept {
  if (bucket < 2 * kHalf) return static_cast<std::int64_t>(bucket);
  const std::size_t shift = bucket / kHalf - 1;
  const std::uint64_t leading = bucket - shift * kHalf;
  return static_cast<std::int64_t>(((leading + 1) << shift) - 1);
}

void LogLinearHistogram::record(std::int64_t value_ns) noexcept TERRACUT_NONBLOCKING {
  const std::int64_t value = std::max<std::int64_t>(value_ns, 0);
  ++buckets_[bucket_of(static_cast<std::uint64_t>(std::min(value, kMax_ns)))];
  ++count_;
  min_ns_ = std::min(min_ns_, value);
  max_ns_ = std::max(max_ns_, value);
  sum_ns_ += static_cast<double>(value);
}

std::int64_t LogLinearHistogram::percentile_ns(double percent) const noexcept {
  if (count_ == 0) return 0;
  const double share = std::clamp(percent, 0.0, 100.0) / 100.0;
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  const std::uint64_t rank = std::clamp<std::uint64_t>(wanted, 1, count_);
  if (rank == count_) return max_ns_;
  std::uint64_t seen = 0;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    seen += buckets_[bucket];
    if (seen >= rank) return std::min(highest_in(bucket), max_ns_);
  }
  return max_ns_;
}

double LogLinearHistogram::mean_ns() const noexcept {
  return count_ == 0 ? 0.0 : sum_ns_ / static_cast<double>(count_);
}

std::uint64_t LogLinearHistogram::count_not_above(std::int64_t limit_ns) const noexcept {
  std::uint64_t sum = 0;
  for (std::size_t bucket = 0; bucket < kBuckets && highest_in(bucket) <= limit_ns; ++bucket)
    sum += buckets_[bucket];
  return sum;
}

}  // namespace terracut::measure
