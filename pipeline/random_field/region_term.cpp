// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/random_field/region_term.hpp"

#include <algorithm>
#include <limits>

#include "pipeline/stage/portable_math.hpp"

namespace terracut::random_field {
RegionTerm::RegionTerm(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory)
    : config_(config),
      cost_ground_(memory.take<std::int32_t>("energy", shape.cells())),
      cost_obstacle_(memory.take<std::int32_t>("energy", shape.cells())) {}

void RegionTerm::evaluate(const frame::RangeImage& image, const stage::CellPlanes& planes,
                          std::span<const min_cut::Seed> seeds) noexcept {
  if (config_.rule == RegionRule::kHistogram) {
    evaluate_histogram(image, seeds);
  } else {
    evaluate_ramp(planes, seeds);
  }
}

void RegionTerm::evaluate_ramp(const stage::CellPlanes& planes,
                               std::span<const min_cut::Seed> seeds) noexcept {
  const float full = config_.lambda * static_cast<float>(min_cut::kCapacityScale);
  min_cut::for_each_unknown(seeds, [&](std::size_t cell) noexcept {
    const float lean =
        std::clamp((planes.height_m[cell] - config_.even_height_m) / config_.ramp_m, -1.0F, 1.0F);
    const auto cost = static_cast<std::int32_t>(lean * full);
    cost_ground_[cell] = std::max(cost, 0);
    cost_obstacle_[cell] = std::max(-cost, 0);
  });
}

void RegionTerm::evaluate_histogram(const frame::RangeImage& image,
                                    std::span<const min_cut::Seed> seeds) noexcept {
  const auto z_m = image.z_m();
  float lowest_ground_m = std::numeric_limits<float>::max();
  for (std::size_t cell = 0; cell < seeds.size(); ++cell) {
    if (seeds[cell] == min_cut::Seed::kGround)
      lowest_ground_m = std::min(lowest_ground_m, z_m[cell]);
  }
  if (lowest_ground_m == std::numeric_limits<float>::max()) lowest_ground_m = 0;  // no ground seed

  // Eq. 10; heights outside the histogram count in its end bins.
  const auto bin_of = [&](std::size_t cell) noexcept {
    const float bin = (z_m[cell] - lowest_ground_m) * config_.bins_per_metre + 0.5F;
    return static_cast<std::size_t>(std::clamp(bin, 0.0F, static_cast<float>(kMaxBins - 1)));
  };
  Histogram ground{}, obstacle{};
  for (std::size_t cell = 0; cell < seeds.size(); ++cell) {
    if (seeds[cell] == min_cut::Seed::kGround) ++ground[bin_of(cell)];
    if (seeds[cell] == min_cut::Seed::kObstacle) ++obstacle[bin_of(cell)];
  }
  const BinCosts ground_costs = costs_of(ground), obstacle_costs = costs_of(obstacle);
  min_cut::for_each_unknown(seeds, [&](std::size_t cell) noexcept {
    const std::size_t bin = bin_of(cell);
    cost_ground_[cell] = ground_costs[bin];
    cost_obstacle_[cell] = obstacle_costs[bin];
  });
}

RegionTerm::BinCosts RegionTerm::costs_of(const Histogram& counts) const noexcept {
  double total = 0;
  for (const std::uint32_t count : counts) total += count;
  const auto floor = static_cast<double>(config_.empty_bin_count);
  const double log_total = stage::portable_log(total + floor * kMaxBins);
  const double scale = static_cast<double>(config_.lambda) * min_cut::kCapacityScale;
  BinCosts costs{};
  for (std::size_t bin = 0; bin < counts.size(); ++bin) {
    const double cost = scale * (log_total - stage::portable_log(counts[bin] + floor));
    costs[bin] = static_cast<std::int32_t>(std::min(cost, double{min_cut::kMaxTerminalCost}));
  }
  return costs;
}

}  // namespace terracut::random_field
