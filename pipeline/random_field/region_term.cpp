// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/random_field/region_term.hpp"

#include <algorithm>
#include <limits>

#include "pipeline/stage/portable_math.hpp"

namespace terracut::random_field {

void RegionTerm::look_at(const frame::PointPlanes& points, const stage::CellPlanes& planes,
                         std::span<const min_cut::Seed> seeds) noexcept {
  z_m_ = points.z_m;
  height_m_ = planes.height_m;
  if (config_.rule == RegionRule::kHistogram) count_seeds(seeds);
}

void RegionTerm::count_seeds(std::span<const min_cut::Seed> seeds) noexcept {
  lowest_ground_m_ = std::numeric_limits<float>::max();
  for (std::size_t cell = 0; cell < seeds.size(); ++cell) {
    if (seeds[cell] == min_cut::Seed::kGround)
      lowest_ground_m_ = std::min(lowest_ground_m_, z_m_[cell]);
  }
  if (lowest_ground_m_ == std::numeric_limits<float>::max()) lowest_ground_m_ = 0;  // no such seed

  Histogram ground{}, obstacle{};
  for (std::size_t cell = 0; cell < seeds.size(); ++cell) {
    if (seeds[cell] == min_cut::Seed::kGround) ++ground[bin_of(z_m_[cell])];
    if (seeds[cell] == min_cut::Seed::kObstacle) ++obstacle[bin_of(z_m_[cell])];
  }
  ground_costs_ = costs_of(ground);
  obstacle_costs_ = costs_of(obstacle);
}

RegionTerm::BinCosts RegionTerm::costs_of(const Histogram& counts) const noexcept {
  double total = 0;
  for (const std::uint32_t count : counts) total += count;
  constexpr double kAdded = 1;  // to every bin: an empty one would cost infinity
  const double log_total = stage::portable_log(total + kAdded * kMaxBins);
  const double scale = static_cast<double>(config_.lambda) * min_cut::kCapacityScale;
  BinCosts costs{};
  for (std::size_t bin = 0; bin < counts.size(); ++bin) {
    const double cost = scale * (log_total - stage::portable_log(counts[bin] + kAdded));
    costs[bin] = static_cast<std::int32_t>(std::min(cost, double{min_cut::kMaxTerminalCost}));
  }
  return costs;
}

}  // namespace terracut::random_field
