// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "pipeline/stage/float_lanes.hpp"
#include "pipeline/stage/portable_math.hpp"

namespace terracut::random_field {

/// The rule by which two neighbouring returns tend to the same label.
enum class BoundaryRule : std::uint8_t {
  kHeightGradient,  ///< exp(-sigma dh^2 / d), Eq. 14: dh is the height difference, d the distance.
  kNearness,        ///< exp(-distance / scale); the scale grows with range.
};

/// Stage 3b, the boundary term B(A) of the energy (paper, Eq. 8, 9, 14, 15): the weight of an edge
/// between neighbouring returns. A value type that views one frame; satisfies EdgeWeights.
class BoundaryTerm {
 public:
  struct Config {
    BoundaryRule rule = BoundaryRule::kNearness;
    // Settings of kHeightGradient
    float sigma = 10.0F;  ///< Adjustment coefficient of Eq. 14, 1/m.
    // Settings of kNearness
    float scale_m = 0.10F;          ///< Distance at which the weight is 1/e, at range 0.
    float scale_per_metre = 0.01F;  ///< Growth of that distance per metre of range.
  };

  /// `points` covers the whole image and must be valid at unknown cells and next to them.
  BoundaryTerm(const Config& config, const stage::NegativeExp& negative_exp,
               const frame::PointPlanes& points) noexcept
      : rule_(config.rule),
        sigma_(all(config.sigma)),
        scale_m_(all(config.scale_m)),
        scale_per_two_metres_(all(0.5F * config.scale_per_metre)),
        exp_(&negative_exp),
        x_m_(points.x_m),
        y_m_(points.y_m),
        z_m_(points.z_m),
        ground_range_m_(points.ground_range_m) {}

  [[gnu::always_inline]] void operator()(
      std::uint32_t cell, const min_cut::NeighbourCells& neighbours,
      std::span<std::uint16_t, min_cut::kDirections> out) const noexcept {
    const Eight x = differences(x_m_, cell, neighbours), y = differences(y_m_, cell, neighbours),
                z = differences(z_m_, cell, neighbours);
    const Eight range = around(ground_range_m_, neighbours);
    const FourFloats own_range = all(ground_range_m_[cell]);
    const FourInts even = weights(x.even, y.even, z.even, own_range + range.even);
    const FourInts odd = weights(x.odd, y.odd, z.odd, own_range + range.odd);
    const FourInts interleaved = even | odd << 16;
    static_assert(sizeof(interleaved) == out.size_bytes());
    std::memcpy(out.data(), &interleaved, sizeof(interleaved));
  }

 private:
  /// The least d of Eq. 14: on walls d nears 0 and the exponent infinity.
  static constexpr float kLeastDistance_m = 0.05F;

  using FourFloats = stage::FourFloats;
  using FourInts = stage::FourInts;
  /// One value for each neighbour: those in directions 0, 2, 4, 6, then those in 1, 3, 5, 7.
  struct Eight {
    FourFloats even, odd;
  };

  [[nodiscard]] static FourFloats all(float value) noexcept { return value - FourFloats{}; }
  /// Reads a plane at the eight neighbours; needs three loads away from the image's edges.
  [[gnu::always_inline, nodiscard]] static Eight around(const float* plane,
                                                        const min_cut::NeighbourCells& n) noexcept {
    if (min_cut::are_next_to_each_other(n)) [[likely]] {
      const FourFloats below = stage::load_four(plane + n[0]);
      const FourFloats beside = stage::load_four(plane + n[3]);
      const FourFloats above = stage::load_four(plane + n[5] - 1);
      const FourFloats four_and_six = __builtin_shufflevector(beside, above, 2, 2, 6, 6);
      const FourFloats one_and_three = __builtin_shufflevector(below, beside, 1, 1, 4, 4);
      return {__builtin_shufflevector(below, four_and_six, 0, 2, 4, 6),
              __builtin_shufflevector(one_and_three, above, 0, 2, 5, 7)};
    }
    return {FourFloats{plane[n[0]], plane[n[2]], plane[n[4]], plane[n[6]]},
            FourFloats{plane[n[1]], plane[n[3]], plane[n[5]], plane[n[7]]}};
  }
  [[gnu::always_inline, nodiscard]] static Eight differences(
      const float* plane, std::uint32_t cell, const min_cut::NeighbourCells& n) noexcept {
    const Eight there = around(plane, n);
    const FourFloats here = all(plane[cell]);
    return {here - there.even, here - there.odd};
  }

  [[gnu::always_inline, nodiscard]] FourInts weights(FourFloats dx, FourFloats dy, FourFloats dz,
                                                     FourFloats ranges_m) const noexcept {
    const FourFloats along = dx * dx + dy * dy;
    const FourFloats weight =
        rule_ == BoundaryRule::kNearness
            ? (*exp_)(stage::square_root(along + dz * dz) /
                      (scale_m_ + scale_per_two_metres_ * ranges_m))
            : (*exp_)(sigma_ * dz * dz /
                      at_least(stage::square_root(along), all(kLeastDistance_m)));
    return __builtin_convertvector(weight * static_cast<float>(min_cut::kCapacityScale), FourInts);
  }
  [[nodiscard]] static FourFloats at_least(FourFloats four, FourFloats least) noexcept {
    return four < least ? least : four;
  }

  BoundaryRule rule_;
  FourFloats sigma_, scale_m_, scale_per_two_metres_;
  const stage::NegativeExp* exp_;
  const float *x_m_, *y_m_, *z_m_, *ground_range_m_;
};

static_assert(min_cut::EdgeWeights<BoundaryTerm>);

}  // namespace terracut::random_field
