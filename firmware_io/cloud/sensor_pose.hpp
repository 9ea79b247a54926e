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

/// Finds where the sensor stands among points that are in another frame (a levelled one, a
/// vehicle's): the place from which, and the axis around which, the points of each laser lie on a
/// cone. Returns the transform from the sensor frame to the points' frame, whose x axis stays
/// ahead. Returns nothing if the points do not name their lasers (by number, organisation or
/// KITTI's order), or no such place explains them better than their origin. Start-up: allocates,
/// takes up to a second. Deterministic.
[[nodiscard]] std::optional<mount::RigidTransform> find_sensor_pose(std::size_t clouds,
                                                                    const ReadCloud& read);

/// Moves each point that is a place (scan::is_place()) by `T`.
void move_points(const mount::RigidTransform& T, std::span<scan::ScanPoint> points) noexcept;

}  // namespace terracut::cloud
