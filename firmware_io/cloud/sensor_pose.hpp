// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "calib/mount/mount.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "firmware_io/scan/kitti_scan.hpp"

namespace terracut::cloud {

/// Finds the sensor among points that are in another frame (a levelled one, a vehicle's): the
/// position and the axis for which the points of each laser lie on a cone. Returns the transform
/// from the sensor frame to the points' frame, whose x axis stays ahead. Returns nothing if the
/// points do not name their lasers (by number, organisation or KITTI's order), or if no position
/// fits better than the points' own origin. Start-up: allocates, takes up to a second.
/// Deterministic.
[[nodiscard]] std::optional<mount::RigidTransform> find_sensor_pose(std::size_t clouds,
                                                                    const ReadCloud& read);

/// Moves each point with a valid position (scan::is_place()) by `T`.
void move_points(const mount::RigidTransform& T, std::span<scan::ScanPoint> points) noexcept;

}  // namespace terracut::cloud
