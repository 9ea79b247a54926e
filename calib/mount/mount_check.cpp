// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount_check.hpp"

#include <algorithm>
#include <cmath>

#include "calib/mount/mount_estimate.hpp"
#include "calib/mount/mount_finder.hpp"

namespace terracut::mount {
namespace {

/// Returns the number of points on the ground `of` per point on the ground `against`, counted only
/// where the two are at least 0.06 m apart. Both grounds lie below a sensor at (0, 0, 0) and are
/// bent by `bend_per_m`. 0.06 m is twice the sensor's noise to either side; 3.5 degrees of roll
/// move the ground by as much at 1 m beside the sensor.
double support(std::span<const std::array<float, 3>> points, const Mount& of, const Mount& against,
               double bend_per_m) {
  constexpr double kApart_m = 0.06;
  const RigidTransform T_of = T_vehicle_lidar(of), T_against = T_vehicle_lidar(against);
  const auto above_ground_m = [&](const RigidTransform& T, const std::array<float, 3>& p) {
    const auto [x_m, y_m, z_m] = apply(T, double{p[0]}, double{p[1]}, double{p[2]});
    return z_m - bend_per_m * x_m * x_m;
  };
  double for_it = 0, against_it = 0;
  for (const auto& p : points) {
    const double above_m = above_ground_m(T_of, p), above_other_m = above_ground_m(T_against, p);
    if (std::abs(above_m - above_other_m) < kApart_m) continue;
    if (std::abs(above_m) < kApart_m / 2) ++for_it;
    if (std::abs(above_other_m) < kApart_m / 2) ++against_it;
  }
  return for_it / std::max(against_it, 1.0);
}

}  // namespace

MountCheck::MountCheck(const Mount& mount, const MountCheckConfig& config)
    : mount_(mount), config_(config) {}

void MountCheck::add_frame(std::span<const std::array<float, 3>> points) {
  // Moves the origin up to the sensor, where estimate_mount() expects it.
  std::vector<std::array<float, 3>> levelled(points.begin(), points.end());
  const auto height_m = static_cast<float>(mount_.height_m);
  for (auto& point : levelled) point[2] -= height_m;
  const auto found = estimate_mount(levelled);
  if (!found) return;
  Frame frame{on_top_of(mount_, found->mount), false};
  if (contradicts(frame.seen)) {
    const Mount as_given{.height_m = mount_.height_m, .roll_rad = 0, .pitch_rad = 0};
    frame.contradicts =
        support(levelled, as_given, found->mount, found->bend_per_m) < config_.most_support;
  }
  if (!contradicts(frame.seen)) {
    sum_.height_m += frame.seen.height_m;
    sum_.roll_rad += frame.seen.roll_rad;
    sum_.pitch_rad += frame.seen.pitch_rad;
    ++in_sum_;
  }
  if (newest_.size() < config_.frames_kept) {
    newest_.push_back(frame);
  } else {
    newest_[frames_ % config_.frames_kept] = frame;
  }
  ++frames_;
}

bool MountCheck::contradicts(const Mount& seen) const {
  return std::abs(seen.height_m - mount_.height_m) > config_.height_tolerance_m ||
         std::abs(seen.roll_rad - mount_.roll_rad) > config_.roll_tolerance_rad ||
         std::abs(seen.pitch_rad - mount_.pitch_rad) > config_.pitch_tolerance_rad;
}

std::optional<Mount> MountCheck::contradiction() const {
  std::vector<Mount> contradicting;
  for (const Frame& frame : newest_) {
    if (frame.contradicts) contradicting.push_back(frame.seen);
  }
  const bool enough = newest_.size() >= config_.least_frames &&
                      static_cast<double>(contradicting.size()) >=
                          config_.contradicting_share * static_cast<double>(newest_.size());
  if (!enough) return std::nullopt;
  Mount seen = median_of(contradicting);
  if (!contradicts(seen)) return std::nullopt;
  seen.roll_rad = nearest_turn(seen.roll_rad, 0);
  return seen;
}

std::optional<Mount> MountCheck::by_drive() const {
  if (in_sum_ == 0) return std::nullopt;
  const auto frames = static_cast<double>(in_sum_);
  return Mount{sum_.height_m / frames, nearest_turn(sum_.roll_rad / frames, 0),
               sum_.pitch_rad / frames};
}

}  // namespace terracut::mount
