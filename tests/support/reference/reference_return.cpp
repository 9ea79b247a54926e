// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "reference_return.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace terracut::reference {

std::string_view to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kOtherPacket:
      return "other packet";
    case Refusal::kAzimuthRange:
      return "azimuth range";
    case Refusal::kUnequalFirings:
      return "unequal firings";
    case Refusal::kUneven:
      return "uneven";
    case Refusal::kNotRotating:
      return "not rotating";
  }
  return "?";
}

int clockwise_cdeg(int from_cdeg, int to_cdeg) {
  const int around = (to_cdeg - from_cdeg + 36'000) % 36'000;
  return around < 18'000 ? around : around - 36'000;
}

Refusal judge_rotation(std::span<const int> azimuths_cdeg, const RotorLimits& limits) {
  int sweep_cdeg = 0;
  for (std::size_t i = 1; i < azimuths_cdeg.size(); ++i) {
    const int step_cdeg = clockwise_cdeg(azimuths_cdeg[i - 1], azimuths_cdeg[i]);
    if (step_cdeg > limits.forwards_cdeg || -step_cdeg > limits.backwards_cdeg) {
      return Refusal::kUneven;
    }
    sweep_cdeg += step_cdeg;
  }
  if (-sweep_cdeg > limits.standing_back_cdeg) return Refusal::kUneven;
  return sweep_cdeg < limits.least_sweep_cdeg ? Refusal::kNotRotating : Refusal::kNone;
}

double Frames::unwrap(const Packet& packet) {
  double offset_deg = 0;
  if (started_) {
    offset_deg = 360.0 * std::round((last_deg_ - packet.first_deg) / 360.0);
  }
  started_ = true;
  last_deg_ = packet.first_deg + offset_deg;
  return offset_deg;
}

Cell cell_of(double unwrapped_deg, int columns) {
  const double frame = std::floor(unwrapped_deg / 360.0);
  const double pitch_deg = 360.0 / columns;
  const double in_columns = (unwrapped_deg - 360.0 * frame) / pitch_deg;
  Cell cell;
  cell.frame = static_cast<std::int64_t>(frame);
  cell.column = std::min(static_cast<int>(in_columns), columns - 1);
  cell.border_deg = std::abs(in_columns - std::round(in_columns)) * pitch_deg;
  return cell;
}

double seam_distance_deg(double beam_deg) {
  return std::abs(beam_deg - 360.0 * std::round(beam_deg / 360.0));
}

std::vector<double> elevations_of(std::span<const beams::TableBeam> beams) {
  std::vector<double> elevations;
  for (const beams::TableBeam& beam : beams) elevations.push_back(beam.elevation_rad);
  return elevations;
}

std::vector<int> rank_of_elevation(const std::vector<double>& elevations) {
  std::vector<int> ranks;
  for (std::size_t i = 0; i < elevations.size(); ++i) {
    int lower = 0;
    for (std::size_t j = 0; j < elevations.size(); ++j) {
      if (elevations[j] < elevations[i] || (elevations[j] == elevations[i] && j < i)) ++lower;
    }
    ranks.push_back(lower);
  }
  return ranks;
}

}  // namespace terracut::reference
