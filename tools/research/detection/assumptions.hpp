// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

namespace terracut::detection {

/// The ground and the obstacle for which a DetectionBound holds.
struct Assumptions {
  double slope = 0.02;  ///< Most slope of the ground against the mount's plane, any direction.
  double roughness_m = 0.015;  ///< Most height of a ground return above or below a plane.
  double noise_m = 0.03;       ///< Most error of the range of a return from the obstacle.
  double depth_m = 0.5;        ///< Most depth of the obstacle, less than surface.regain_length_m.
};

}  // namespace terracut::detection
