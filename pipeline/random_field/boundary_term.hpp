// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "firmware_io/frame/range_image.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "pipeline/stage/portable_math.hpp"

namespace terracut::random_field {

/// What makes two neighbouring returns want the same label.
enum class BoundaryRule : std::uint8_t {
  kHeightGradient,  ///< exp(-sigma dh^2 / d), Eq. 14: small height difference for its distance.
  kNearness,        ///< exp(-distance / scale): closeness in space, scale growing with range.
};

/// Stage 3b, the boundary term B(A) of the energy (paper, Eq. 8, 9, 14, 15): the weight of an edge
/// between neighbouring returns, in [0, kCapacityScale] and the same both ways. A value type that
/// looks at one frame; satisfies EdgeWeights.
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

  BoundaryTerm(const Config& config, const stage::NegativeExp& negative_exp,
               const frame::RangeImage& image) noexcept
      : config_(&config),
        exp_(&negative_exp),
        x_m_(image.x_m().data()),
        y_m_(image.y_m().data()),
        z_m_(image.z_m().data()),
        ground_range_m_(image.ground_range_m().data()) {}

  void operator()(std::uint32_t cell, const min_cut::NeighbourCells& neighbours,
                  std::span<std::uint16_t, min_cut::kDirections> out) const noexcept {
    // One kind of step for all eight at a time, so that the compiler takes several at once.
    std::array<float, min_cut::kDirections> along, dz, range_m, exponent;
    for (std::size_t d = 0; d < min_cut::kDirections; ++d) {
      const std::size_t other = neighbours[d];
      const float dx = x_m_[cell] - x_m_[other];
      const float dy = y_m_[cell] - y_m_[other];
      along[d] = dx * dx + dy * dy;
      dz[d] = z_m_[cell] - z_m_[other];
      range_m[d] = ground_range_m_[cell] + ground_range_m_[other];
    }
    if (config_->rule == BoundaryRule::kHeightGradient) {
      for (std::size_t d = 0; d < min_cut::kDirections; ++d)
        exponent[d] = by_gradient(along[d], dz[d]);
    } else {
      for (std::size_t d = 0; d < min_cut::kDirections; ++d) {
        exponent[d] = by_nearness(along[d], dz[d], range_m[d]);
      }
    }
    for (std::size_t d = 0; d < min_cut::kDirections; ++d) {
      out[d] = static_cast<std::uint16_t>((*exp_)(exponent[d]) *
                                          static_cast<float>(min_cut::kCapacityScale));
    }
  }

 private:
  /// What the weight falls with, from the square of the horizontal distance, the height difference
  /// and the sum of both ranges.
  [[nodiscard]] float by_gradient(float along_squared, float dz) const noexcept {
    return config_->sigma * dz * dz / std::max(std::sqrt(along_squared), config_->min_distance_m);
  }
  [[nodiscard]] float by_nearness(float along_squared, float dz, float ranges_m) const noexcept {
    const float scale_m = config_->scale_m + config_->scale_per_metre * (0.5F * ranges_m);
    return std::sqrt(along_squared + dz * dz) / scale_m;
  }

  const Config* config_;
  const stage::NegativeExp* exp_;
  const float *x_m_, *y_m_, *z_m_, *ground_range_m_;
};

static_assert(min_cut::EdgeWeights<BoundaryTerm>);

}  // namespace terracut::random_field
