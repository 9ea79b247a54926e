// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "cell_tally.hpp"

#include <algorithm>
#include <bit>

namespace terracut::report {

std::size_t point_bin(std::uint32_t points) noexcept {
  return std::min<std::size_t>(static_cast<std::size_t>(std::bit_width(points)),
                               kPointBinNames.size() - 1);
}

CellSums& CellSums::operator+=(const CellSums& other) noexcept {
  cells += other.cells;
  empty += other.empty;
  points += other.points;
  points_squared += other.points_squared;
  obstacles += other.obstacles;
  obstacles_on_no_ground += other.obstacles_on_no_ground;
  return *this;
}

void CellTally::add(const CellGrid& grid, const std::vector<Sample>& samples) {
  cells_.assign(grid.centre_range_m().size(), {});
  for (const Sample& sample : samples) {
    const auto index = grid.cell_of(sample.place);
    if (!index) continue;
    Cell& cell = cells_[*index];
    ++cell.points;
    cell.ground += sample.kind == Kind::kGround ? 1 : 0;
    cell.obstacles += sample.kind == Kind::kObstacle ? 1 : 0;
  }
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const float range_m = grid.centre_range_m()[i];
    const auto* const annulus = std::ranges::find_if(kAnnuli, [&](const Annulus& candidate) {
      return range_m >= candidate.from_m && range_m < candidate.to_m;
    });
    if (annulus == kAnnuli.end()) continue;
    const Cell& cell = cells_[i];
    const double points = cell.points;
    CellSums one{1, cell.points == 0 ? 1U : 0U, points, points * points, cell.obstacles, 0};
    if (cell.ground == 0) one.obstacles_on_no_ground = cell.obstacles;
    annuli_[static_cast<std::size_t>(annulus - kAnnuli.begin())] += one;
    ++histogram_[point_bin(cell.points)];
  }
}

}  // namespace terracut::report
