// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::random_field {

/// The rule for the cost of calling an unknown return ground or obstacle.
enum class RegionRule : std::uint8_t {
  /// -lambda ln of the seeds' height histograms: Eq. 10-13, read as cost(obstacle) = -ln D_obj and
  /// cost(ground) = -ln D_bkg (as printed, both use D_obj).
  kHistogram,
  /// A ramp by the height above the local ground, the same in every frame.
  kHeightRamp,
};

/// Stage 3b, the region term lambda * R(A) of the energy (paper, Eq. 6, 7, 10-13).
class RegionTerm {
 public:
  static constexpr int kMaxBins = 1024;

  struct Config {
    RegionRule rule = RegionRule::kHeightRamp;
    float lambda = 1.0F;  ///< Weight against the boundary term, > 0.
    // Settings of kHistogram
    float bins_per_metre = 10.0F;  ///< k of Eq. 10.
    // Settings of kHeightRamp
    float even_height_m = 0.12F;  ///< Ground and obstacle cost the same at this height.
    float ramp_m = 0.15F;  ///< Farther than this from even_height_m the cost stays at lambda.
  };

  explicit RegionTerm(const Config& config) noexcept : config_(config) {}

  /// Begins a frame: the calls that follow are about its cells. kHistogram needs `points` at all
  /// seeds; kHeightRamp needs no points. Real-time safe.
  void look_at(const frame::PointPlanes& points, const stage::CellPlanes& planes,
               std::span<const min_cut::Seed> seeds) noexcept TERRACUT_NONBLOCKING;

  /// Returns the costs of an unknown cell, scaled by kCapacityScale.
  [[nodiscard]] min_cut::LabelCosts operator()(std::uint32_t cell) const noexcept {
    if (config_.rule == RegionRule::kHistogram) {
      const std::size_t bin = bin_of(z_m_[cell]);
      return {ground_costs_[bin], obstacle_costs_[bin]};
    }
    const float lean =
        std::clamp((height_m_[cell] - config_.even_height_m) / config_.ramp_m, -1.0F, 1.0F);
    const float full = config_.lambda * static_cast<float>(min_cut::kCapacityScale);
    const auto cost = static_cast<std::int32_t>(lean * full);
    return {std::max(cost, 0), std::max(-cost, 0)};
  }

 private:
  using Histogram = std::array<std::uint32_t, kMaxBins>;
  using BinCosts = std::array<std::int32_t, kMaxBins>;
  void count_seeds(std::span<const min_cut::Seed> seeds) noexcept;
  [[nodiscard]] BinCosts costs_of(const Histogram& counts) const noexcept;
  /// Returns the bin of Eq. 10; heights outside the histogram count in its end bins.
  [[nodiscard]] std::size_t bin_of(float z_m) const noexcept {
    const float bin = (z_m - lowest_ground_m_) * config_.bins_per_metre + 0.5F;
    return static_cast<std::size_t>(std::clamp(bin, 0.0F, static_cast<float>(kMaxBins - 1)));
  }

  Config config_;
  const float* z_m_ = nullptr;
  std::span<const float> height_m_;
  // State of kHistogram
  float lowest_ground_m_ = 0;
  BinCosts ground_costs_{}, obstacle_costs_{};
};

static_assert(min_cut::RegionCosts<RegionTerm>);

}  // namespace terracut::random_field
