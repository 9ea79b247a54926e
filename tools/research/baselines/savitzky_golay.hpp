// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <span>

namespace terracut::baselines {

/// Weights of the Savitzky-Golay filter for the middle of a window: they give the value there of
/// the quadratic that fits the window best. So quadratics pass unchanged, and noise is averaged.
class SavitzkyGolay {
 public:
  static constexpr int kMaxWindow = 15;

  /// `window` is in [1, kMaxWindow]; an even width counts as the next odd width. A window of up to
  /// 3 values smooths nothing: three values fix a quadratic.
  explicit SavitzkyGolay(int window) noexcept : reach_(window / 2) {
    assert(window >= 1 && window <= kMaxWindow);
    weights_[0] = 1.0F;
    if (reach_ == 0) return;
    const double m = reach_;
    const double scale = 3.0 / ((2 * m + 3) * (2 * m + 1) * (2 * m - 1));
    for (int k = -reach_; k <= reach_; ++k) {
      weights_[static_cast<std::size_t>(k + reach_)] =
          static_cast<float>(scale * (3 * m * m + 3 * m - 1 - 5.0 * k * k));
    }
  }

  [[nodiscard]] int reach() const noexcept { return reach_; }  ///< Values on each side.
  /// Returns the weights of the values from -reach() to reach(); their sum is 1.
  [[nodiscard]] std::span<const float> weights() const noexcept {
    return std::span(weights_).first(static_cast<std::size_t>(2 * reach_ + 1));
  }

 private:
  int reach_;
  std::array<float, kMaxWindow> weights_{};
};

}  // namespace terracut::baselines
