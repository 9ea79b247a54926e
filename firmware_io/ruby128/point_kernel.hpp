// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/mount/mount.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"
#include "firmware_io/decode/beam_columns.hpp"
#include "firmware_io/decode/column_returns.hpp"
#include "firmware_io/decode/rotor_directions.hpp"
#include "firmware_io/ruby128/firing_azimuth.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ruby128 {

/// Raw distances of a firing to points of the vehicle frame: the formulas of Ruby128Geometry
/// and mount::Mount in float, for all 128 channels in one loop that compilers vectorise. Agrees
/// with those double functions to within 1 mm + 1e-6 of the range; the same bits on every machine,
/// as the HDL-64E's PointKernel.
///
/// Real-time safe but for the constructor. One thread.
class Ruby128PointKernel {
 public:
  static constexpr auto kLasers = static_cast<std::size_t>(kRuby128Lasers);

  Ruby128PointKernel(const Ruby128Calibration& calibration, const mount::Mount& mount, int columns,
                     memory::FixedMemory& memory);

  /// How far the head rotates from firing to firing, for the firings to come; [0, 1e5] ticks.
  void set_step(std::int32_t step_ticks) noexcept TERRACUT_NONBLOCKING;

  /// Points, columns and frame offsets from `column.raw`, for a firing whose head azimuth is
  /// `azimuth_cdeg`, [0, 36000).
  void compute(std::int32_t azimuth_cdeg,
               decode::ColumnReturns<kLasers>& column) const noexcept TERRACUT_NONBLOCKING;

 private:
  /// By channel, taken once from the calibration.
  struct Constants {
    alignas(64) std::array<float, kLasers> sin_offset, cos_offset, sin_elevation, cos_elevation;
  };
  /// By channel, for one step: the head's advance until the channel fires, and the beam's offset
  /// from the block's azimuth.
  struct Offsets {
    alignas(64) std::array<float, kLasers> sin_advance, cos_advance, sin_beam, cos_beam;
    alignas(64) std::array<std::int32_t, kLasers> ticks;
  };

  /// The same with its tables passed for __restrict: without it the loop is not vectorised in
  /// clones.
  void compute(const Constants& __restrict k, const Offsets& __restrict offset,
               std::int32_t azimuth_cdeg,
               decode::ColumnReturns<kLasers>& __restrict out) const noexcept TERRACUT_NONBLOCKING;

  Ruby128BeamOffsets beam_offsets_;
  decode::BeamColumns columns_;
  decode::RotorDirections head_;
  std::array<float, 12> T_vehicle_lidar_;
  std::span<Constants> constants_;  ///< One element.
  std::span<Offsets> offsets_;      ///< One element.
  std::int32_t step_ticks_ = -1;
};

}  // namespace terracut::ruby128
