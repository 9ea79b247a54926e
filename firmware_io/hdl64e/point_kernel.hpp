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

/// Converts measured distances of one laser to points of the vehicle frame by the formulas of
/// Hdl64eGeometry and mount::Mount, in float: one loop, which compilers vectorise, for all firings
/// of a tile. Agrees with these functions in double to within 1 mm + 1e-6 of the range.
///
/// Uses only +, -, *, sqrt, min and abs per point, so that every machine gets the same bits; the
/// constants are computed in double at start. Sines and cosines of the head's azimuth, of its
/// advance and of the laser's rotational correction are combined by the addition theorems.
///
/// Real-time safe except for the constructor. One thread.
class PointKernel {
 public:
  static constexpr auto kLasers = static_cast<std::size_t>(kHdl64eLasers);

  PointKernel(const Hdl64eCalibration& calibration, GeometryModel model,
              const mount::Mount& mount) noexcept;

  /// Computes the points of a laser. `heads` are those of the laser's group, `measured_m` its wire
  /// distances in metres, NaN for no return.
  void compute(std::size_t laser, const packet::LaserHeads& heads,
               const frame::TileRow<float>& measured_m,
               const frame::PointsOut& out) const noexcept TERRACUT_NONBLOCKING;

 private:
  struct Laser {
    float sin_rot, cos_rot, sin_vert, cos_vert;
    float far_m, near_x_m, near_y_m, slope_x, slope_y;
    float horiz_m, xy_start_m, z_start_m;
  };

  /// Everything that this function reads and writes is a parameter, so that it can be __restrict:
  /// otherwise the compiler does not vectorise the loop in the function's clones
  /// (TERRACUT_VECTOR_CLONES).
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
