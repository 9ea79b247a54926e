// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/ring_grid.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rt/vector_clones.hpp"

namespace terracut::elevation {
namespace {

/// Returns the outer ends of all bands, ascending; the last is the range limit.
std::vector<double> band_ends_m(const RingGrid::Config& config, const mount::RingProfile& profile) {
  const auto limit_m = static_cast<double>(config.range_limit_m);
  std::vector<double> ring_m;
  for (const mount::Ring& ring : profile.rings) {
    if (ring.ground_distance_m < limit_m) ring_m.push_back(ring.ground_distance_m);
  }
  std::sort(ring_m.begin(), ring_m.end());

  const auto min_m = static_cast<double>(config.min_band_m);
  const auto max_m = static_cast<double>(config.max_band_m);
  std::vector<double> ends;
  double inner = 0;
  const auto close_band_at = [&](double outer) {
    const double depth = outer - inner;
    if (depth < min_m || depth <= 0) return;  // left open, to merge with the next
    const int parts = std::max(1, static_cast<int>(std::ceil(depth / max_m)));
    for (int part = 1; part <= parts; ++part) ends.push_back(inner + depth * part / parts);
    inner = outer;
  };
  // The blind zone within the first ring is one band, however deep: nothing is measured there.
  if (!ring_m.empty()) {
    inner = std::max(0.0, ring_m.front() - std::min(max_m, ring_m.front()) / 2);
    if (inner > 0) ends.push_back(inner);
  }
  for (std::size_t i = 1; i < ring_m.size(); ++i) close_band_at((ring_m[i - 1] + ring_m[i]) / 2);
  close_band_at(limit_m);
  if (ends.empty()) ends.push_back(limit_m);
  if (ends.size() > RingGrid::kMaxBands) ends.resize(RingGrid::kMaxBands);
  ends.back() = std::max(ends.back(), limit_m);
  return ends;
}

/// Returns how far apart the rings around a range lie on level ground: beyond the last ring, as far
/// as the range limit; 0 within the first ring.
double spacing_around(double range_m, const RingGrid::Config& config,
                      const mount::RingProfile& profile) {
  double inner_m = 0, outer_m = static_cast<double>(config.range_limit_m);
  for (const mount::Ring& ring : profile.rings) {
    if (ring.ground_distance_m <= range_m) inner_m = std::max(inner_m, ring.ground_distance_m);
    if (ring.ground_distance_m > range_m) outer_m = std::min(outer_m, ring.ground_distance_m);
  }
  return inner_m > 0 ? std::max(outer_m - inner_m, 0.0) : 0.0;
}

TERRACUT_VECTOR_CLONES void find_steps_up_to(float last_step,
                                             const float* __restrict ground_range_m,
                                             std::span<std::uint16_t> steps) noexcept {
  const std::size_t count = steps.size();
  std::uint16_t* const __restrict out = steps.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float step = ground_range_m[i] * RingGrid::kStepsPerMetre;
    out[i] =
        static_cast<std::uint16_t>(static_cast<std::int32_t>(step < last_step ? step : last_step));
  }
}

}  // namespace

RingGrid::RingGrid(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
                   memory::FixedMemory& memory) {
  const std::vector<double> ends = band_ends_m(config, profile);
  bands_ = static_cast<int>(ends.size());
  center_m_ = memory.take<float>("ring grid", ends.size());
  unseen_m_ = memory.take<float>("ring grid", ends.size());
  for (std::size_t band = 0; band < ends.size(); ++band) {
    center_m_[band] = static_cast<float>(((band == 0 ? 0.0 : ends[band - 1]) + ends[band]) / 2);
    unseen_m_[band] = std::max(
        static_cast<float>(spacing_around(double{center_m_[band]}, config, profile)) - kFarApart_m,
        0.0F);
    if (band > 0) {
      deepest_band_m_ = std::max(deepest_band_m_, static_cast<float>(ends[band] - ends[band - 1]));
    }
  }

  last_step_ = config.range_limit_m * kStepsPerMetre;
  const auto steps = static_cast<std::size_t>(last_step_) + 1;
  band_of_step_ = memory.take<std::uint8_t>("ring grid", steps);
  mixes_ = memory.take<BandMix>("ring grid", steps);
  std::size_t band = 0;
  for (std::size_t step = 0; step < steps; ++step) {
    const float range_m = (static_cast<float>(step) + 0.5F) / kStepsPerMetre;
    while (band + 1 < ends.size() && static_cast<double>(range_m) >= ends[band]) ++band;
    band_of_step_[step] = static_cast<std::uint8_t>(band);

    const bool leans_outward = range_m > center_m_[band];
    const std::size_t inner = leans_outward || band == 0 ? band : band - 1;
    const std::size_t outer = leans_outward ? std::min(band + 1, ends.size() - 1) : band;
    const float depth_m = center_m_[outer] - center_m_[inner];
    mixes_[step] = {static_cast<std::int32_t>(inner),
                    depth_m > 0 ? (range_m - center_m_[inner]) / depth_m : 0.0F};
  }

  sectors_ = (shape.columns + config.columns_per_sector - 1) / config.columns_per_sector;
  sector_of_column_ =
      memory.take<std::uint16_t>("ring grid", static_cast<std::size_t>(shape.columns));
  first_cell_of_column_ = memory.take<std::int32_t>("ring grid", sector_of_column_.size());
  share_across_ = memory.take<float>("ring grid", sector_of_column_.size());
  first_column_ = memory.take<std::uint16_t>("ring grid", static_cast<std::size_t>(sectors_) + 1);
  for (int column = shape.columns - 1; column >= 0; --column) {
    // Sectors are spread evenly, so that the last one is not narrow.
    sector_of_column_[static_cast<std::size_t>(column)] =
        static_cast<std::uint16_t>(std::int64_t{column} * sectors_ / shape.columns);
    first_cell_of_column_[static_cast<std::size_t>(column)] =
        static_cast<std::int32_t>(cell(sector_of(column), 0));
    first_column_[static_cast<std::size_t>(sector_of(column))] = static_cast<std::uint16_t>(column);
  }
  first_column_.back() = static_cast<std::uint16_t>(shape.columns);
  for (int column = 0; column < shape.columns; ++column) {
    const frame::ColumnRange own = columns_of({sector_of(column), sector_of(column) + 1});
    share_across_[static_cast<std::size_t>(column)] =
        (static_cast<float>(column - own.begin) + 0.5F) / static_cast<float>(own.size());
  }
}

void RingGrid::find_steps(std::span<const float> ground_range_m,
                          std::span<std::uint16_t> steps) const noexcept {
  find_steps_up_to(last_step_, ground_range_m.data(), steps);
}

}  // namespace terracut::elevation
