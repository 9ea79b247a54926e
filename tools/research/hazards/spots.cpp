// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "spots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "local_ground.hpp"

namespace terracut::hazards {

Spots::Spots(const LabelledFrame& frame) : frame_(frame), places_(frame) {
  for (std::uint32_t i = 0; i < frame.size(); ++i) {
    if (!frame.ground[i]) continue;
    const double range_m = frame.ground_range_m(i);
    for (std::size_t bin = 0; bin < kRangeBins.size(); ++bin) {
      if (range_m < kRangeBins[bin].from_m || range_m >= kRangeBins[bin].to_m) continue;
      has_ground_ = true;
      candidates_[static_cast<std::size_t>(*frame.ground[i])][bin].push_back({range_m, i});
    }
  }
  for (auto& of_kind : candidates_) {
    for (auto& of_bin : of_kind) {
      std::ranges::sort(of_bin, {},
                        [](const Candidate& one) { return std::pair(one.range_m, one.index); });
    }
  }
}

std::optional<std::uint32_t> Spots::near(const std::vector<Candidate>& candidates, double range_m,
                                         world::Random& random) const {
  constexpr double kAbout = 0.05;
  const auto from =
      std::ranges::lower_bound(candidates, (1 - kAbout) * range_m, {}, &Candidate::range_m);
  const auto to = std::ranges::upper_bound(from, candidates.end(), (1 + kAbout) * range_m, {},
                                           &Candidate::range_m);
  if (from == to) return std::nullopt;
  return (from + random.pick(static_cast<int>(to - from)))->index;
}

bool Spots::is_free(const Hazard::Extent& extent, GroundKind ground,
                    const Eigen::Isometry3d& T_vehicle_hazard) const {
  constexpr double kAround_m = 0.2, kAbove_m = 0.5, kOtherShare = 0.1;
  const Eigen::Isometry3d T_hazard_vehicle = T_vehicle_hazard.inverse();
  const Eigen::Vector3d middle = T_vehicle_hazard.translation();
  const double reach_m = kAround_m + std::hypot(std::max(-extent.least_x_m, extent.most_x_m),
                                                std::max(-extent.least_y_m, extent.most_y_m));
  int same = 0, other = 0;
  bool is_taken = false;
  places_.around(middle.x(), middle.y(), reach_m, [&](std::uint32_t i) {
    const Eigen::Vector3d at = T_hazard_vehicle * frame_.at[i];
    if (at.x() < extent.least_x_m - kAround_m || at.x() > extent.most_x_m + kAround_m ||
        at.y() < extent.least_y_m - kAround_m || at.y() > extent.most_y_m + kAround_m ||
        at.z() > extent.height_m + kAbove_m) {
      return;
    }
    if (!frame_.ground[i]) {
      is_taken = true;
    } else {
      ++(*frame_.ground[i] == ground ? same : other);
    }
  });
  return !is_taken && same > 0 && other <= kOtherShare * (same + other);
}

std::optional<Eigen::Isometry3d> Spots::draw(const Hazard& hazard, GroundKind ground,
                                             std::size_t bin, world::Random& random) const {
  constexpr int kDraws = 40;
  constexpr double kLeastAround_m = 1.5,
                   kAroundShare = 0.08;  // share of the distance: far rows lie farther apart
  constexpr double kOffGround_m = 0.1, kFacing_rad = 15 * std::numbers::pi / 180;
  const auto& candidates = candidates_[static_cast<std::size_t>(ground)][bin];
  const double from_m = std::max(kRangeBins[bin].from_m, hazard.nearest_m);
  const double to_m = std::min(kRangeBins[bin].to_m, hazard.farthest_m);
  if (candidates.empty() || from_m >= to_m) return std::nullopt;
  const Hazard::Extent extent = hazard.extent();
  std::vector<Eigen::Vector3d> around;
  for (int i = 0; i < kDraws; ++i) {
    const double wanted_m = random.uniform(from_m, to_m);
    const auto index = near(candidates, wanted_m, random);
    const double turn = random.uniform(-1, 1);
    if (!index) continue;
    const Eigen::Vector3d& at = frame_.at[*index];
    const double range_m = frame_.ground_range_m(*index);
    if (range_m < from_m || range_m >= to_m) continue;
    around.clear();
    places_.around(at.x(), at.y(), std::max(kLeastAround_m, kAroundShare * range_m),
                   [&](std::uint32_t j) {
                     if (frame_.ground[j] == ground) around.push_back(frame_.at[j]);
                   });
    const auto plane = local_ground(around, at.x(), at.y());
    if (!plane || std::abs(plane->height_m - at.z()) > kOffGround_m) continue;
    const Eigen::Vector3d way = at - frame_.sensor;
    const double heading_rad = hazard.faces_sensor
                                   ? std::atan2(way.y(), way.x()) + turn * kFacing_rad
                                   : turn * std::numbers::pi;
    Eigen::Isometry3d T_vehicle_hazard = Eigen::Isometry3d::Identity();
    T_vehicle_hazard.translation() = Eigen::Vector3d(at.x(), at.y(), plane->height_m);
    // The shortest turn from z to the normal; Eigen's FromTwoVectors takes long to compile.
    const Eigen::Vector3d up = plane->normal();
    const double twice_w = std::sqrt(2 * (1 + up.z()));
    T_vehicle_hazard.linear() =
        Eigen::Quaterniond(twice_w / 2, -up.y() / twice_w, up.x() / twice_w, 0).toRotationMatrix() *
        Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    if (is_free(extent, ground, T_vehicle_hazard)) return T_vehicle_hazard;
  }
  return std::nullopt;
}

}  // namespace terracut::hazards
