// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stage/row_steps.hpp"

#include <cmath>

#include "calib/beams/angle.hpp"

namespace terracut::stage {
namespace {

/// Tolerance for tables rounded to hundredths or thousandths of a degree: their differences may be
/// a little too small.
constexpr double kRounding_rad = beams::deg_to_rad(1e-6);

}  // namespace

int rows_that_meet_ground(const mount::RingProfile& profile) noexcept {
  int rows = 0;
  for (std::size_t row = 0; row < profile.rings.size(); ++row) {
    if (std::isfinite(profile.rings[row].ground_distance_m)) rows = static_cast<int>(row) + 1;
  }
  return rows;
}

RowSteps::RowSteps(const mount::RingProfile& profile, double step_deg)
    : profile_(&profile), step_rad_(beams::deg_to_rad(step_deg)) {}

int RowSteps::up(int row, int steps) const noexcept {
  const double least_rad = elevation_rad(row) + steps * step_rad_ - kRounding_rad;
  int found = row + steps;
  while (found < rows() && elevation_rad(found) < least_rad) ++found;
  return found < rows() ? found : rows();
}

int RowSteps::down(int row, int steps) const noexcept {
  const double most_rad = elevation_rad(row) - steps * step_rad_ + kRounding_rad;
  int found = row - steps;
  while (found >= 0 && elevation_rad(found) > most_rad) --found;
  return found >= 0 ? found : -1;
}

}  // namespace terracut::stage
