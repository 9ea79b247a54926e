// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>

#include "calib/mount/mount.hpp"
#include "calib/velodyne/velodyne_calibration.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::velodyne {

/// Converts measured distances of one laser to points of the vehicle frame, in float, for the
/// firings of a tile in one loop that compilers vectorise. With t = the head's azimuth when the
/// laser fires, h = its azimuth offset, v = its elevation, o = its vertical offset
/// (docs/reference/sensors.md):
///
///   x = d cos v cos(t + h),  y = -d cos v sin(t + h),  z = d sin v + o
///
/// and mount::Mount; within 1 mm + 1e-6 of the range of these in double, and the same bits on every
/// machine. Real-time safe but for the constructor. One thread.
class PointKernel {
 public:
  static constexpr std::size_t kMostLasers = 128;

  PointKernel(const VelodyneCalibration& calibration, const mount::Mount& mount) noexcept;

  /// `heads` are of the laser's group. `measured_m` are wire distances, NaN for no return.
  void compute(std::size_t laser, const packet::LaserHeads& heads,
               const frame::TileRow<float>& measured_m,
               const frame::PointsOut& out) const noexcept TERRACUT_NONBLOCKING;

 private:
  struct Laser {
    float sin_offset, cos_offset, sin_elevation, cos_elevation, vert_offset_m;
  };

  /// All it reads and writes is passed as a parameter, for __restrict: without it the loop is not
  /// vectorised in clones.
  void compute(const Laser& __restrict laser, const float* __restrict sin_rotor,
               const float* __restrict cos_rotor, const float* __restrict sin_advance,
               const float* __restrict cos_advance, const float* __restrict measured_m,
               float* __restrict x_m, float* __restrict y_m, float* __restrict z_m,
               float* __restrict ground_range_m) const noexcept TERRACUT_NONBLOCKING;

  std::array<float, 12> T_vehicle_lidar_;
  std::array<Laser, kMostLasers> laser_{};
};

}  // namespace terracut::velodyne
