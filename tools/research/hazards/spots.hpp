// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ground_kind.hpp"
#include "hazard.hpp"
#include "labelled_frame.hpp"
#include "returns_by_place.hpp"
#include "tools/lab/world/random.hpp"

namespace terracut::hazards {

/// A range of horizontal distances from the sensor, [from, to).
struct RangeBin {
  double from_m = 0, to_m = 0;
};
inline constexpr std::array kRangeBins{RangeBin{5, 10}, RangeBin{10, 20}, RangeBin{20, 40},
                                       RangeBin{40, 60}};

/// Finds where a hazard can be put into a frame.
class Spots {
 public:
  /// `frame` must outlive this object.
  explicit Spots(const LabelledFrame& frame);

  /// True if the frame has ground in any bin.
  [[nodiscard]] bool has_ground() const noexcept { return has_ground_; }

  /// Returns T_vehicle_hazard at a random place: on a ground return of that kind, at a distance
  /// uniform in the bin, upright on the plane of the ground around it. Within 0.2 m of the hazard
  /// all returns are ground, and at most a tenth of them ground of other kinds. Returns none if 40
  /// random places do not meet this.
  [[nodiscard]] std::optional<Eigen::Isometry3d> draw(const Hazard& hazard, GroundKind ground,
                                                      std::size_t bin, world::Random& random) const;

 private:
  struct Candidate {
    double range_m;
    std::uint32_t index;
  };
  /// Returns a random candidate whose distance differs from `range_m` by at most 5 %; none if there
  /// is no such candidate.
  [[nodiscard]] std::optional<std::uint32_t> near(const std::vector<Candidate>& candidates,
                                                  double range_m, world::Random& random) const;
  [[nodiscard]] bool is_free(const Hazard::Extent& extent, GroundKind ground,
                             const Eigen::Isometry3d& T_vehicle_hazard) const;

  const LabelledFrame& frame_;
  ReturnsByPlace places_;
  bool has_ground_ = false;
  /// Ground returns by kind and range bin, in order of distance.
  std::array<std::array<std::vector<Candidate>, kRangeBins.size()>, kGroundKinds.size()>
      candidates_;
};

}  // namespace terracut::hazards
