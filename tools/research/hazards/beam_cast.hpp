// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Geometry>

#include <cstdint>

#include "hazard.hpp"
#include "labelled_frame.hpp"
#include "moved_return.hpp"

namespace terracut::hazards {

/// Returns of a hazard count if they lie higher than this above its foot, metres. What is lower is
/// as good as ground.
inline constexpr double kFoot_m = 0.05;

/// Returns which returns move if a hazard is put into a frame. A return whose beam meets the hazard
/// or what comes with it nearer than its range moves there, with noise of 1.5 cm along the beam. A
/// ground return within a hole moves to the shaft's wall or bottom, and counts. `key` decides
/// noise, and which leaves are met.
[[nodiscard]] MovedReturns put_in(const LabelledFrame& frame, const Hazard& hazard,
                                  const Eigen::Isometry3d& T_vehicle_hazard, std::uint64_t key);

}  // namespace terracut::hazards
