// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/hdl64e/hdl64e_geometry.hpp"
#include "calib/mount/mount.hpp"
#include "firmware_io/decode/beam_columns.hpp"
#include "firmware_io/decode/column_returns.hpp"
#include "firmware_io/decode/rotor_directions.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::hdl64e {

/// Raw distances of a column to points of the vehicle frame: the formulas of Hdl64eGeometry
/// and mount::Mount in float, for all 64 lasers in one loop that compilers vectorise. Agrees with
/// those double functions to within 1 mm + 1e-6 of the range.
///
/// Only +, -, *, sqrt, min and abs are used per point, so that every machine gets the same bits;
/// the tables behind them are made in double at start. Sine and cosine of the head's azimuth come
/// from a table of the wire's 36000 steps; the lasers' own offsets from it are turned into sines
/// and cosines once a packet, and both are combined by the addition theorems.
///
/// Real-time safe but for the constructor. One thread.
class PointKernel {
 public:
  static constexpr auto kLasers = static_cast<std::size_t>(kHdl64eLasers);

  PointKernel(const Hdl64eCalibration& calibration, GeometryModel model, const mount::Mount& mount,
              int columns, memory::FixedMemory& memory);

  /// `advance_ticks`: how far the head has rotated since its column's azimuth when laser j of
  /// either block fires, [0, 1e5]. `offset_ticks`: beam minus column azimuth of each laser.
  void begin_packet(std::span<const std::int32_t, kLasers / 2> advance_ticks,
                    std::span<const std::int32_t, kLasers> offset_ticks) noexcept
      TERRACUT_NONBLOCKING;

  /// Points, columns and frame offsets from `column.raw`, for a column whose head azimuth is
  /// `azimuth_cdeg`, [0, 36000).
  void compute(std::int32_t azimuth_cdeg,
               decode::ColumnReturns<kLasers>& column) const noexcept TERRACUT_NONBLOCKING;

 private:
  /// By laser, taken once from the calibration.
  struct Constants {
    alignas(64) std::array<float, kLasers> sin_rot, cos_rot, sin_vert, cos_vert;
    alignas(64) std::array<float, kLasers> far_m, near_x_m, near_y_m, slope_x, slope_y;
    alignas(64) std::array<float, kLasers> horiz_m, xy_start_m, z_start_m;
  };
  /// By laser, taken once a packet: the beam's offset from its column's azimuth.
  struct Offsets {
    alignas(64) std::array<float, kLasers> sin, cos;
    alignas(64) std::array<std::int32_t, kLasers> ticks;
  };

  /// The same with its tables passed for __restrict: without it the loop is not vectorised in
  /// clones.
  void compute(const Constants& __restrict k, const Offsets& __restrict offset,
               std::int32_t azimuth_cdeg,
               decode::ColumnReturns<kLasers>& __restrict out) const noexcept TERRACUT_NONBLOCKING;

  float resolution_m_;
  float interpolation_end_m_;
  decode::BeamColumns columns_;
  std::array<float, 12> T_vehicle_lidar_;
  decode::RotorDirections head_;
  std::span<Constants> constants_;  ///< One element.
  std::span<Offsets> offsets_;      ///< One element.
};

}  // namespace terracut::hdl64e
