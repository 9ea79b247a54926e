// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/hdl64e/hdl64e_geometry.hpp"
#include "calib/mount/mount.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::hdl64e {

/// Converts measured distances of one laser to points of the vehicle frame: the formulas of
/// Hdl64eGeometry and mount::Mount in float, for the firings of a tile in one loop that compilers
/// vectorise. Agrees with those double functions to within 1 mm + 1e-6 of the range.
///
/// Only +, -, *, sqrt, min and abs are used per point, so that every machine gets the same bits;
/// the constants behind them are made in double at start. Sines and cosines of the head's azimuth,
/// of its advance and of the laser's rotational correction are combined by the addition theorems.
///
/// Real-time safe but for the constructor. One thread.
class PointKernel {
 public:
  static constexpr auto kLasers = static_cast<std::size_t>(kHdl64eLasers);

  PointKernel(const Hdl64eCalibration& calibration, GeometryModel model,
              const mount::Mount& mount) noexcept;

  /// `heads` are of the laser's group. `measured_m` are wire distances, NaN for no return.
  void compute(std::size_t laser, const packet::LaserHeads& heads,
               const frame::TileRow<float>& measured_m,
               const frame::PointsOut& out) const noexcept TERRACUT_NONBLOCKING;

 private:
  struct Laser {
    float sin_rot, cos_rot, sin_vert, cos_vert;
    float far_m, near_x_m, near_y_m, slope_x, slope_y;
    float horiz_m, xy_start_m, z_start_m;
  };

  /// All it reads and writes is passed as a parameter, for __restrict: without it the loop is not
  /// vectorised in clones.
  void compute(const Laser& __restrict laser, const float* __restrict sin_rotor,
               const float* __restrict cos_rotor, const float* __restrict sin_advance,
               const float* __restrict cos_advance, const float* __restrict measured_m,
               float* __restrict x_m, float* __restrict y_m, float* __restrict z_m,
               float* __restrict ground_range_m) const noexcept TERRACUT_NONBLOCKING;

  float interpolation_end_m_;
  std::array<float, 12> T_vehicle_lidar_;
  std::array<Laser, kLasers> laser_;
};

}  // namespace terracut::hdl64e
