// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount_check.hpp"

#include <algorithm>
#include <cmath>

#include "calib/mount/mount_estimate.hpp"

namespace terracut::mount {
namespace {

/// Any mount that can be configured, whatever the one in use. An RS-Ruby128 3 m up has some 250
/// points in the strip; a quarter of the candidates where the result is kept finds a plane of 20 %
/// of the points with 98 %, and there are more frames.
constexpr MountEstimateConfig kAnyMount{
    .min_height_m = 0.2, .max_height_m = 6.0, .min_points = 150, .candidates = 500};

/// The mount of a sensor whose ground is seen as by `seen` from a frame that `mount` has already
/// levelled.
Mount on_top_of(const Mount& mount, const Mount& seen) {
  const RigidTransform T = T_vehicle_lidar(mount), T_seen = T_vehicle_lidar(seen);
  std::array<double, 3> up{};  // the ground's normal seen from the sensor
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < 3; ++i) up[axis] += T_seen[8 + i] * T[4 * i + axis];
  }
  return {seen.height_m, std::atan2(up[1], up[2]), std::asin(std::clamp(-up[0], -1.0, 1.0))};
}

/// Of the points at places where the two grounds, below a sensor at (0, 0, 0), lie apart: how many
/// lie on the one for each that lies on the other. 0.06 m is twice the sensor's own noise to either
/// side, and what 3.5 degrees of roll make 1 m beside the sensor, inside of the strip.
double support(std::span<const std::array<float, 3>> points, const Mount& of,
               const Mount& against) {
  constexpr double kApart_m = 0.06;
  const RigidTransform T_of = T_vehicle_lidar(of), T_against = T_vehicle_lidar(against);
  double for_it = 0, against_it = 0;
  for (const auto& p : points) {
    const double above_m = apply(T_of, double{p[0]}, double{p[1]}, double{p[2]})[2];
    const double above_other_m = apply(T_against, double{p[0]}, double{p[1]}, double{p[2]})[2];
    if (std::abs(above_m - above_other_m) < kApart_m) continue;
    if (std::abs(above_m) < kApart_m / 2) ++for_it;
    if (std::abs(above_other_m) < kApart_m / 2) ++against_it;
  }
  return for_it / std::max(against_it, 1.0);
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

MountCheck::MountCheck(const Mount& mount, const MountCheckConfig& config)
    : mount_(mount), config_(config) {}

void MountCheck::add_frame(std::span<const std::array<float, 3>> points) {
  // Seen from the sensor, levelled as the mount says.
  std::vector<std::array<float, 3>> levelled(points.begin(), points.end());
  const auto height_m = static_cast<float>(mount_.height_m);
  for (auto& point : levelled) point[2] -= height_m;
  const auto found = estimate_mount(levelled, kAnyMount);
  if (!found) return;
  Frame frame{on_top_of(mount_, found->mount), false};
  if (contradicts(frame.seen)) {
    const Mount as_given{.height_m = mount_.height_m, .roll_rad = 0, .pitch_rad = 0};
    frame.contradicts = support(levelled, as_given, found->mount) < config_.most_support;
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
  std::vector<double> height_m, roll_rad, pitch_rad;
  for (const Frame& frame : newest_) {
    if (!frame.contradicts) continue;
    height_m.push_back(frame.seen.height_m);
    roll_rad.push_back(frame.seen.roll_rad);
    pitch_rad.push_back(frame.seen.pitch_rad);
  }
  const bool enough = newest_.size() >= config_.least_frames &&
                      static_cast<double>(height_m.size()) >=
                          config_.contradicting_share * static_cast<double>(newest_.size());
  if (!enough) return std::nullopt;
  const Mount seen{median_of(std::move(height_m)), median_of(std::move(roll_rad)),
                   median_of(std::move(pitch_rad))};
  return contradicts(seen) ? std::optional(seen) : std::nullopt;
}

}  // namespace terracut::mount
