// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/truth_turns.hpp"

#include "calib/angle.hpp"

namespace terracut::firmware_io {

void TruthTurns::add(std::span<const FiringColumn, kColumnsPerPacketSingle> columns) {
  const std::int32_t step_ticks =
      column_step_ticks(calib::wrap_cdeg(columns.front().unwrapped_azimuth_cdeg),
                        calib::wrap_cdeg(columns.back().unwrapped_azimuth_cdeg));
  for (const FiringColumn& column : columns) {
    for (int i = 0; i < calib::kHdl64eLasers; ++i) {
      const LabelledReturn& echo = column.by_laser[static_cast<std::size_t>(i)];
      if (echo.raw == 0) continue;
      const BeamAzimuth beam =
          beam_azimuth(column.unwrapped_azimuth_cdeg, offsets_.offset_ticks(step_ticks, i));
      by_turn_[beam.turn].push_back(echo.truth);
    }
  }
  oldest_reachable_ =
      beam_azimuth(columns.back().unwrapped_azimuth_cdeg, offsets_.hindmost_ticks()).turn;
}

bool TruthTurns::take_finished(std::vector<std::uint32_t>& labels) {
  if (by_turn_.empty() || by_turn_.begin()->first >= oldest_reachable_) return false;
  return take_any(labels);
}

bool TruthTurns::take_any(std::vector<std::uint32_t>& labels) {
  if (by_turn_.empty()) return false;
  labels = std::move(by_turn_.begin()->second);
  by_turn_.erase(by_turn_.begin());
  return true;
}

}  // namespace terracut::firmware_io
