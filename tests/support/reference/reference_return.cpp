// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tests/support/reference/reference_return.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace terracut::reference {

std::string_view to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kSize:
      return "size";
    case Refusal::kOtherKind:
      return "other kind";
    case Refusal::kAzimuthRange:
      return "azimuth range";
    case Refusal::kUnequalFirings:
      return "unequal firings";
    case Refusal::kNotTurning:
      return "not turning";
    case Refusal::kUneven:
      return "uneven";
  }
  return "?";
}

double Turns::unwrap(const Packet& packet) {
  double offset_deg = 0;
  if (started_) {
    offset_deg = 360.0 * std::round((last_deg_ - packet.first_deg) / 360.0);
  }
  started_ = true;
  last_deg_ = packet.first_deg + offset_deg;
  return offset_deg;
}

Cell cell_of(double unwrapped_deg, int columns) {
  const double turn = std::floor(unwrapped_deg / 360.0);
  const double pitch_deg = 360.0 / columns;
  const double in_columns = (unwrapped_deg - 360.0 * turn) / pitch_deg;
  Cell cell;
  cell.turn = static_cast<std::int64_t>(turn);
  cell.column = std::min(static_cast<int>(in_columns), columns - 1);
  cell.border_deg = std::abs(in_columns - std::round(in_columns)) * pitch_deg;
  return cell;
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
