// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace terracut::quality {

/// Finds percentiles of absolute errors by counting them in a fixed number of bins, however many
/// there are.
class ErrorCounts {
 public:
  /// Errors are counted to within `width`; an error beyond `bins` * `width` counts as that limit.
  ErrorCounts(double width, std::size_t bins) : width_(width), counts_(bins + 1) {}

  void add(double error) {
    const auto bin = static_cast<std::size_t>(std::abs(error) / width_);
    ++counts_[std::min(bin, counts_.size() - 1)];
    ++count_;
    squares_ += error * error;
  }

  [[nodiscard]] double rms() const {
    return count_ == 0 ? 0 : std::sqrt(squares_ / static_cast<double>(count_));
  }
  /// Returns the error that at most 100 - `percent` percent of all errors exceed; 0 if there are
  /// none.
  [[nodiscard]] double percentile(std::uint64_t percent) const {
    std::uint64_t not_above = 0;
    for (std::size_t bin = 0; count_ != 0 && bin < counts_.size(); ++bin) {
      not_above += counts_[bin];
      if (100 * not_above >= percent * count_) return width_ * static_cast<double>(bin + 1);
    }
    return 0;
  }

 private:
  double width_;
  std::vector<std::uint64_t> counts_;
  std::uint64_t count_ = 0;
  double squares_ = 0;
};

}  // namespace terracut::quality
