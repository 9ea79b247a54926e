// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Geometry>

#include <cstdint>

#include "hazard.hpp"
#include "labelled_frame.hpp"
#include "moved_return.hpp"

namespace terracut::hazards {

/// A hazard's returns count if they lie higher than this above its foot. Lower ones may be called
/// ground.
inline constexpr double kFoot_m = 0.05;

/// Puts a hazard into a frame and returns the returns that it moves. A return moves to the point
/// where its beam first meets a shape of the hazard, if that is nearer than its range; noise of 1.5
/// cm along the beam is added. A ground return within a hole moves to the shaft's wall or bottom,
/// and counts. `key` seeds the noise and decides which beams are stopped by leaves.
[[nodiscard]] MovedReturns put_in(const LabelledFrame& frame, const Hazard& hazard,
                                  const Eigen::Isometry3d& T_vehicle_hazard, std::uint64_t key);

}  // namespace terracut::hazards
