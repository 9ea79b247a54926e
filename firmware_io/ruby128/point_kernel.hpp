// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "calib/mount/mount.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ruby128 {

/// Converts measured distances of one channel to points of the vehicle frame: the formulas of
/// beams::StraightGeometry and mount::Mount in float, for the firings of a tile in one loop that
/// compilers vectorise. Agrees with those double functions to within 1 mm + 1e-6 of the range; the
/// same bits on every machine, as the HDL-64E's PointKernel.
///
/// Real-time safe but for the constructor. One thread.
class Ruby128PointKernel {
 public:
  static constexpr auto kLasers = static_cast<std::size_t>(kRuby128Lasers);

  Ruby128PointKernel(const Ruby128Calibration& calibration, const mount::Mount& mount) noexcept;

  /// `heads` are of the channel's group. `measured_m` are wire distances, NaN for no return.
  void compute(std::size_t channel, const packet::LaserHeads& heads,
               const frame::TileRow<float>& measured_m,
               const frame::PointsOut& out) const noexcept TERRACUT_NONBLOCKING;

 private:
  struct Channel {
    float sin_offset, cos_offset, sin_elevation, cos_elevation;
  };

  /// All it reads and writes is passed as a parameter, for __restrict: without it the loop is not
  /// vectorised in clones.
  void compute(const Channel& __restrict channel, const float* __restrict sin_rotor,
               const float* __restrict cos_rotor, const float* __restrict sin_advance,
               const float* __restrict cos_advance, const float* __restrict measured_m,
               float* __restrict x_m, float* __restrict y_m, float* __restrict z_m,
               float* __restrict ground_range_m) const noexcept TERRACUT_NONBLOCKING;

  std::array<float, 12> T_vehicle_lidar_;
  std::array<Channel, kLasers> channel_;
};

}  // namespace terracut::ruby128
