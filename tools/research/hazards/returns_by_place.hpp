// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <vector>

#include "labelled_frame.hpp"

namespace terracut::hazards {

/// The returns of a frame up to 80 m away, sorted into squares of 1 m x 1 m.
class ReturnsByPlace {
 public:
  /// `frame` must outlive this object.
  explicit ReturnsByPlace(const LabelledFrame& frame);

  /// Calls `visit(index)` for every return within `radius_m` of (x, y), measured horizontally.
  template <class Visitor>
  void around(double x_m, double y_m, double radius_m, Visitor&& visit) const {
    const Bounds x = bounds(x_m, radius_m), y = bounds(y_m, radius_m);
    for (int row = y.first; row <= y.last; ++row) {
      for (int column = x.first; column <= x.last; ++column) {
        const auto square = static_cast<std::size_t>(row * kSide + column);
        for (std::uint32_t i = first_[square]; i < first_[square + 1]; ++i) {
          const Eigen::Vector3d& at = frame_.at[indices_[i]];
          const double dx_m = at.x() - x_m, dy_m = at.y() - y_m;
          if (dx_m * dx_m + dy_m * dy_m <= radius_m * radius_m) visit(indices_[i]);
        }
      }
    }
  }

 private:
  static constexpr int kFarthest_m = 80, kSide = 2 * kFarthest_m;
  struct Bounds {
    int first, last;
  };
  [[nodiscard]] static Bounds bounds(double middle_m, double radius_m) noexcept;

  const LabelledFrame& frame_;
  std::vector<std::uint32_t> first_;    ///< Position in indices_ of each square's first return.
  std::vector<std::uint32_t> indices_;  ///< Return indices, square after square.
};

}  // namespace terracut::hazards
