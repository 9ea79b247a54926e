// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"
#include "tools/research/datasets/class_table.hpp"

namespace terracut::statistics {

/// The ground of a labelled scan (GroundDefinition::kAll): mean heights on squares of half a metre,
/// up to 100 m away.
class TrueGround {
 public:
  explicit TrueGround(const datasets::ClassTable& classes);

  void look_at(const scan::KittiScan& scan);

  /// Returns the height of the ground around a place, weighting the nearest squares most; nothing
  /// if no square within 2 m has ground.
  [[nodiscard]] std::optional<double> height_m(double x_m, double y_m) const;

 private:
  struct Square {
    double sum_m = 0;
    int points = 0;
  };

  const datasets::ClassTable& classes_;
  std::vector<Square> squares_;
};

}  // namespace terracut::statistics
