// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "firmware_io/frame/range_image.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::random_field {

/// Where the costs of calling an unknown return ground or obstacle come from.
enum class RegionRule : std::uint8_t {
  /// -lambda ln of the seeds' height histograms: Eq. 10-13, read as cost(obstacle) = -ln D_obj and
  /// cost(ground) = -ln D_bkg (as printed, both use D_obj).
  kHistogram,
  /// A ramp in the height above the local ground, the same in every frame.
  kHeightRamp,
};

/// Stage 3b, the region term lambda * R(A) of the energy (paper, Eq. 6, 7, 10-13).
class RegionTerm {
 public:
  static constexpr int kMaxBins = 1024;

  struct Config {
    RegionRule rule = RegionRule::kHeightRamp;
    float lambda = 1.0F;  ///< Weight against the boundary term, > 0.
    // kHistogram
    float bins_per_metre = 10.0F;  ///< k of Eq. 10.
    float empty_bin_count = 1.0F;  ///< Floor of every bin (an empty one would cost infinity), > 0.
    // kHeightRamp
    float even_height_m = 0.13F;  ///< Ground and obstacle cost the same at this height.
    float ramp_m = 0.15F;         ///< Beyond this far from it the cost stays at lambda.
  };

  RegionTerm(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory);

  /// Costs of all unknown cells, scaled by kCapacityScale; other cells are left as they were.
  /// Real-time safe.
  void evaluate(const frame::RangeImage& image, const stage::CellPlanes& planes,
                std::span<const min_cut::Seed> seeds) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] std::span<const std::int32_t> cost_ground() const noexcept { return cost_ground_; }
  [[nodiscard]] std::span<const std::int32_t> cost_obstacle() const noexcept {
    return cost_obstacle_;
  }

 private:
  void evaluate_histogram(const frame::RangeImage& image,
                          std::span<const min_cut::Seed> seeds) noexcept;
  void evaluate_ramp(const stage::CellPlanes& planes,
                     std::span<const min_cut::Seed> seeds) noexcept;

  using Histogram = std::array<std::uint32_t, kMaxBins>;
  using BinCosts = std::array<std::int32_t, kMaxBins>;
  [[nodiscard]] BinCosts costs_of(const Histogram& counts) const noexcept;

  Config config_;
  std::span<std::int32_t> cost_ground_;
  std::span<std::int32_t> cost_obstacle_;
};

}  // namespace terracut::random_field
