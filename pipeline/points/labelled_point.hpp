// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "firmware_io/frame/label.hpp"

namespace terracut::points {

/// A labelled return inside the program. All outputs (stream, page, MCAP, DDS, Foxglove, Python,
/// LiveRun) are made from these points.
struct LabelledPoint {
  float x_m = 0, y_m = 0, z_m = 0;  ///< Vehicle frame (calib/mount/mount.hpp).
  std::uint8_t intensity = 0;       ///< Intensity as the sensor sends it, 0 to 255.
  frame::Label label = frame::Label::kNone;
  std::uint16_t row = 0;  ///< Row of the range image; 0 is the lowest laser.
  float time_s = 0;       ///< Time after the first firing of the frame's first packet.

  bool operator==(const LabelledPoint&) const = default;
};

}  // namespace terracut::points
