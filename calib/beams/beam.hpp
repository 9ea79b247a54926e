// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

namespace terracut::beams {

/// A point in the sensor frame (calib/mount/mount.hpp): x forward, y left, z up, metres.
struct Point {
  double x_m = 0, y_m = 0, z_m = 0;
};

/// A direction in the sensor frame, of any length.
struct Direction {
  double x = 0, y = 0, z = 0;
};

/// A straight beam, given by its start and its unit direction, both in the sensor frame.
struct Ray {
  Point origin;
  Direction direction;
};

/// The largest raw distance in a packet, in counts; 0 means "no return".
inline constexpr double kMaxRawCounts = 65535.0;

}  // namespace terracut::beams
