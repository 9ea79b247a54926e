// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/beams/angle.hpp"
#include "firmware_io/decode/sensor_trait.hpp"
#include "firmware_io/decode/step_advances.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::decode {

/// Finds the image columns of the beams of a tile.
template <SensorTrait Sensor>
class TileColumns {
 public:
  /// `columns` is the number of columns of the range image, [16, 36000].
  TileColumns(const Sensor& sensor, int columns, memory::FixedMemory& memory)
      : columns_(columns),
        advance_column_(
            memory.take<frame::TileRow<std::int32_t>>("decoder tables", Sensor::kGroups)),
        advance_rest_(memory.take<frame::TileRow<std::int32_t>>("decoder tables", Sensor::kGroups)),
        advances_(memory) {
    for (std::size_t i = 0; i < offset_.size(); ++i) {
      offset_[i] = packet::column_angle(sensor.beam_ticks(static_cast<int>(i)), columns);
    }
  }

  /// Fills `beams`, one for each laser. Columns are counted in the frame in which `heads` are.
  /// Real-time safe.
  void find(const Sensor& sensor, const frame::TileHeads& heads,
            std::span<frame::BeamColumns> beams) noexcept TERRACUT_NONBLOCKING {
    alignas(64) frame::TileRow<std::int32_t> head_column, head_rest;
    for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
      const std::int32_t azimuth_cdeg = beams::wrap_cdeg(heads.head_cdeg[f]);
      const std::int32_t revolution = (heads.head_cdeg[f] - azimuth_cdeg) / beams::kRevolution_cdeg;
      const packet::ColumnAngle angle =
          packet::column_angle(std::int64_t{azimuth_cdeg} * packet::kTicksPerCdeg, columns_);
      head_column[f] = angle.whole + revolution * columns_;
      head_rest[f] = angle.rest;
    }
    advances_.spread(
        heads,
        [&](Columns& of, std::int32_t step_ticks, bool is_dual) noexcept {
          for (std::size_t group = 0; group < Sensor::kGroups; ++group) {
            const packet::ColumnAngle angle =
                packet::column_angle(sensor.advance_ticks(step_ticks, group, is_dual), columns_);
            of.whole[group] = angle.whole;
            of.rest[group] = angle.rest;
          }
        },
        [this](const Columns& of) noexcept {
          packet::fill_rows(of.whole, advance_column_[0].data());
          packet::fill_rows(of.rest, advance_rest_[0].data());
        },
        [this](const Columns& of, const FiringMask& mask) noexcept {
          packet::spread_rows(of.whole, mask, advance_column_[0].data());
          packet::spread_rows(of.rest, mask, advance_rest_[0].data());
        });
    for (std::size_t i = 0; i < offset_.size(); ++i) {
      const std::size_t group = sensor.group(i);
      packet::find_columns(head_column.data(), head_rest.data(), advance_column_[group].data(),
                           advance_rest_[group].data(), offset_[i], beams[i]);
    }
  }

 private:
  /// How far the head advances from a firing's azimuth until each group of lasers fires.
  struct Columns {
    std::array<std::int32_t, Sensor::kGroups> whole{}, rest{};
  };

  int columns_;
  std::array<packet::ColumnAngle, static_cast<std::size_t>(Sensor::kChannels)>
      offset_;  ///< Beam offsets from the head.
  std::span<frame::TileRow<std::int32_t>> advance_column_, advance_rest_;  ///< Indexed by group.
  StepAdvances<Columns> advances_;
};

}  // namespace terracut::decode
