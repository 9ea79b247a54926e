// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>

#include "firmware_io/cloud/sensor_rows.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// Makes rows for clouds that show no lasers: of sensors whose pattern is not made of rows or never
/// repeats, of several sensors in one cloud, of a vehicle's or any other frame. A row is then a bin
/// of elevation, and cells are squares of the mean solid angle of a point, so that most hold one
/// point or none. Where the origin lies on the ground, as that of a vehicle's frame does, points
/// are seen from 1.8 m above it (SensorRows::viewpoint_above_m). Takes at most 40 of the clouds.
///
/// Fails with kUnsupported for clouds of fewer than 1,000 points in the mean, and for those whose
/// points lie in fewer than kFewestLasers bins; with the error of `read` if no cloud can be read.
/// Whether there is a ground among the points is for the search of the mount to say. Start-up:
/// allocates. Deterministic.
[[nodiscard]] Expected<SensorRows> bin_elevations(std::size_t clouds, const ReadCloud& read);

/// Returns `rows`, which learn_rows() gave for these clouds, or bin_elevations() where it failed or
/// they are doubtful (doubt_of()); the bins then say why. Returns `rows` also if there are no bins.
[[nodiscard]] Expected<SensorRows> rows_or_bins(Expected<SensorRows> rows, std::size_t clouds,
                                                const ReadCloud& read);

/// Learns the rows of clouds by their lasers (learn_rows()) or, where these are not found or
/// doubtful (doubt_of()), by bin_elevations(). Fails with the error of learn_rows() if neither can
/// be had, and where check_reach() fails.
[[nodiscard]] Expected<SensorRows> learn_rows_or_bins(std::size_t clouds, const ReadCloud& read);

}  // namespace terracut::cloud
