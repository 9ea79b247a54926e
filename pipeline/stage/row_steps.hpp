// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/mount/ring_profile.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::stage {

/// Returns the number of rows up to the highest whose beams meet the ground; 0 if none does.
[[nodiscard]] int rows_that_meet_ground(const mount::RingProfile& profile) noexcept;

/// Steps from row to row by angle. Rows may be unevenly spaced: those of an RS-Ruby128 are 0.1
/// degrees apart around the horizon and up to 5.4 degrees below, an HDL-64E's a third or half a
/// degree. A step goes to the next row, or over as many rows as it takes to cover `step_deg`; so k
/// steps cover about the same angle on any sensor. If step_deg is 0, a step is one row, as in the
/// paper.
///
/// For use in constructors: each call searches the profile, O(rows).
class RowSteps {
 public:
  /// `profile` must outlive this object.
  RowSteps(const mount::RingProfile& profile, double step_deg);

  /// Returns the first row at least `steps` rows and `steps` times step_deg above `row`; the number
  /// of rows if there is none. steps >= 0.
  [[nodiscard]] int up(int row, int steps) const noexcept TERRACUT_NONBLOCKING;
  /// Returns the first row at least `steps` rows and `steps` times step_deg below `row`; -1 if
  /// there is none. steps >= 0.
  [[nodiscard]] int down(int row, int steps) const noexcept TERRACUT_NONBLOCKING;

 private:
  [[nodiscard]] int rows() const noexcept { return static_cast<int>(profile_->rings.size()); }
  [[nodiscard]] double elevation_rad(int row) const noexcept {
    return profile_->rings[static_cast<std::size_t>(row)].elevation_rad;
  }

  const mount::RingProfile* profile_;
  double step_rad_;
};

}  // namespace terracut::stage
