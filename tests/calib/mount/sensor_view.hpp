// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/mount/mount.hpp"

namespace terracut::test {

inline mount::Mount mount_in_degrees(double height_m, double roll_deg, double pitch_deg) {
  return {height_m, beams::deg_to_rad(roll_deg), beams::deg_to_rad(pitch_deg)};
}

/// Points of the vehicle frame as a sensor on `mount` has them.
class SensorView {
 public:
  explicit SensorView(const mount::Mount& mount) : T_(mount::T_vehicle_lidar(mount)) {}

  void add(double x, double y, double z) {
    const double d[3] = {x - T_[3], y - T_[7], z - T_[11]};
    std::array<float, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) {  // transposed rotation
      p[i] = static_cast<float>(T_[i] * d[0] + T_[4 + i] * d[1] + T_[8 + i] * d[2]);
    }
    points_.push_back(p);
  }
  [[nodiscard]] const std::vector<std::array<float, 3>>& points() const { return points_; }

 private:
  mount::RigidTransform T_;
  std::vector<std::array<float, 3>> points_;
};

}  // namespace terracut::test
