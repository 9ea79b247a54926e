// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "truth_turns.hpp"

#include <cstddef>
#include <utility>

#include "calib/beams/angle.hpp"
#include "firmware_io/decode/beam_azimuth.hpp"
#include "transmitter.hpp"

namespace terracut::drive {

template <class Transmitter>
void TruthTurns<Transmitter>::add(std::span<const Column> columns) {
  const auto returns = static_cast<std::size_t>(returns_per_firing(returns_));
  GroupAzimuths head_cdeg{};
  for (std::size_t i = 0; i < columns.size(); i += returns) {
    head_cdeg[i / returns] = beams::wrap_cdeg(columns[i].unwrapped_azimuth_cdeg);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::int32_t step_ticks =
        Transmitter::step_ticks(head_cdeg, static_cast<int>(i / returns), returns_);
    for (int laser = 0; laser < Transmitter::kLasers; ++laser) {
      const frame::LabelledReturn& echo = columns[i].by_laser[static_cast<std::size_t>(laser)];
      if (echo.raw == 0) continue;
      const std::int32_t offset_ticks =
          Transmitter::offset_ticks(offsets_, step_ticks, laser, returns_);
      const decode::BeamAzimuth beam =
          decode::beam_azimuth(columns[i].unwrapped_azimuth_cdeg, offset_ticks);
      by_turn_[beam.turn].push_back(echo.truth);
    }
  }
  oldest_reachable_ =
      decode::beam_azimuth(columns.back().unwrapped_azimuth_cdeg, offsets_.hindmost_ticks()).turn;
}

template <class Transmitter>
bool TruthTurns<Transmitter>::take_finished(std::vector<std::uint32_t>& labels) {
  if (by_turn_.empty() || by_turn_.begin()->first >= oldest_reachable_) return false;
  return take_any(labels);
}

template <class Transmitter>
bool TruthTurns<Transmitter>::take_any(std::vector<std::uint32_t>& labels) {
  if (by_turn_.empty()) return false;
  labels = std::move(by_turn_.begin()->second);
  by_turn_.erase(by_turn_.begin());
  return true;
}

template class TruthTurns<encode::Hdl64eTransmitter>;
template class TruthTurns<encode::Ruby128Transmitter>;

}  // namespace terracut::drive
