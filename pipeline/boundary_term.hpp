// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "pipeline/min_cut/grid_problem.hpp"
#include "pipeline/portable_math.hpp"
#include "pipeline/range_image.hpp"

namespace terracut::pipeline {

/// What makes two neighbouring returns want the same label.
enum class BoundaryRule : std::uint8_t {
  kHeightGradient,  ///< exp(-sigma dh^2 / d), Eq. 14: small height difference for its distance.
  kNearness,        ///< exp(-distance / scale): closeness in space, scale growing with range.
};

/// Stage 3b, the boundary term B(A) of the energy (paper, Eq. 8, 9, 14, 15): the weight of an edge
/// between neighbouring returns. A value type that looks at one frame; satisfies EdgeWeights.
class BoundaryTerm {
 public:
  struct Config {
    BoundaryRule rule = BoundaryRule::kNearness;
    // kHeightGradient
    float sigma = 10.0F;  ///< Adjustment coefficient of Eq. 14, 1/m.
    float min_distance_m =
        0.05F;  ///< Floor of d: on walls d goes to 0 and the exponent to infinity.
    // kNearness
    float scale_m = 0.10F;  ///< Distance at which the weight has fallen to 1/e, at range 0 ...
    float scale_per_metre = 0.01F;  ///< ... and how much it grows per metre of range.
  };

  BoundaryTerm(const Config& config, const NegativeExp& negative_exp,
               const RangeImage& image) noexcept
      : config_(&config),
        exp_(&negative_exp),
        x_m_(image.x_m().data()),
        y_m_(image.y_m().data()),
        z_m_(image.z_m().data()),
        ground_range_m_(image.ground_range_m().data()) {}

  void operator()(std::uint32_t cell, const NeighbourCells& neighbours,
                  std::span<std::uint16_t, kDirections> out) const noexcept {
    for (std::size_t d = 0; d < neighbours.size(); ++d) {
      out[d] = static_cast<std::uint16_t>(weight(cell, neighbours[d]) *
                                          static_cast<float>(kCapacityScale));
    }
  }

  /// Weight of the edge between two cells that hold returns, [0, 1]; the same both ways, bit for
  /// bit.
  [[nodiscard]] float weight(std::size_t p, std::size_t q) const noexcept {
    const float dx = x_m_[p] - x_m_[q];
    const float dy = y_m_[p] - y_m_[q];
    const float dz = z_m_[p] - z_m_[q];
    const float across_squared = dx * dx + dy * dy;
    if (config_->rule == BoundaryRule::kHeightGradient) {
      const float d = std::max(std::sqrt(across_squared), config_->min_distance_m);
      return (*exp_)(config_->sigma * dz * dz / d);
    }
    const float mean_range_m = 0.5F * (ground_range_m_[p] + ground_range_m_[q]);
    const float scale_m = config_->scale_m + config_->scale_per_metre * mean_range_m;
    return (*exp_)(std::sqrt(across_squared + dz * dz) / scale_m);
  }

 private:
  const Config* config_;
  const NegativeExp* exp_;
  const float *x_m_, *y_m_, *z_m_, *ground_range_m_;
};

static_assert(EdgeWeights<BoundaryTerm>);

}  // namespace terracut::pipeline
