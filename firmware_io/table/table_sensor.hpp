// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/beams/beam_table.hpp"
#include "calib/mount/mount.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/straight_point_kernel.hpp"
#include "firmware_io/table/beam_offsets.hpp"
#include "firmware_io/table/column_pace.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::table {

/// What the traits of sensors with a beams::BeamTable share (decode/sensor_trait.hpp). `Model` has
/// the sensor's constants:
/// - `kModel`, `kLayout` with a `pace`, `kMetresPerCount`, `kDefaultColumns`;
/// - `kLasers`, and `kChannels`, the readings of a column: a multiple of kLasers if these fire more
///   than once for one head azimuth;
/// - `kGroups`, `group(channel)` and `group_ns(group)`: which channels fire together, and when
///   after the column's first firing, [0, column_ns);
/// - and it may have `kLensAhead_m`, how far the lens is ahead of the axis of rotation.
template <class Model>
class TableSensor {
  static_assert(sensor::row_of(Model::kModel).lasers.size() == std::size_t{Model::kLasers},
                "the table of sensors and the model have as many lasers");

 public:
  using Calibration = beams::BeamTable;
  static constexpr sensor::SensorModel kModel = Model::kModel;
  static constexpr int kRows = Model::kLasers;
  static constexpr int kChannels = Model::kChannels;
  static constexpr std::size_t kGroups = Model::kGroups;
  static constexpr int kDefaultColumns = Model::kDefaultColumns;
  /// Three are enough for dual return: some cells get more than two returns, where two firings
  /// share a column.
  static constexpr int kDefaultReturnsPerCell = 3;
  using Returns = packet::FiringReturns<static_cast<std::size_t>(kChannels)>;

  TableSensor(const Calibration& calibration, const mount::Mount& mount)
      : kernel_(calibration.lasers, mount, lens_ahead_m<Model>()), offsets_(calibration) {
    const std::vector<int> rows = mount::rows_upward(rows_by_elevation(calibration), mount);
    for (std::size_t channel = 0; channel < rows_.size(); ++channel) {
      rows_[channel] = rows[laser_of(channel)];
    }
  }

  [[nodiscard]] packet::BeamSpread spread(std::int32_t step_ticks) const noexcept {
    return {offsets_.hindmost_ticks(), offsets_.foremost_ticks(step_ticks)};
  }
  [[nodiscard]] std::int32_t beam_ticks(int channel) const noexcept {
    return offsets_.beam_ticks(channel);
  }
  [[nodiscard]] static std::size_t group(std::size_t channel) noexcept {
    return Model::group(channel);
  }
  [[nodiscard]] static std::int32_t advance_ticks(std::int32_t step_ticks, std::size_t group,
                                                  bool /*dual_return*/) noexcept {
    return table::advance_ticks<Model>(step_ticks, group);
  }
  [[nodiscard]] static std::int32_t step_ticks(const packet::PacketAzimuths& azimuths,
                                               std::size_t /*column*/) noexcept {
    return azimuths.step_ticks;
  }
  void compute_points(std::size_t channel, const packet::LaserHeads& heads,
                      const frame::TileRow<float>& measured_m,
                      const frame::PointsOut& out) const noexcept TERRACUT_NONBLOCKING {
    kernel_.compute(laser_of(channel), heads, measured_m, out);
  }
  [[nodiscard]] static float metres_per_count() noexcept {
    return static_cast<float>(Model::kMetresPerCount);
  }
  [[nodiscard]] std::span<const std::int32_t, static_cast<std::size_t>(kChannels)> rows()
      const noexcept {
    return rows_;
  }

 private:
  [[nodiscard]] static std::size_t laser_of(std::size_t channel) noexcept {
    return channel % Model::kLasers;
  }

  packet::StraightPointKernel kernel_;
  BeamOffsets<Model> offsets_;
  std::array<std::int32_t, kChannels> rows_{};
};

}  // namespace terracut::table
