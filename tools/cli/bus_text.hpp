// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <vector>

#include "rt/bus_figures.hpp"

namespace terracut::cli {

/// Lines of printable text on the vehicle's motion, for people: what is known of it; how its clock
/// and the sensor's fit together; what went wrong, if anything did. None where it is not asked for.
[[nodiscard]] std::vector<std::string> motion_lines(const rt::MotionFigures& motion);

/// A line on the reports sent; empty where none are asked for.
[[nodiscard]] std::string health_line(const rt::HealthFigures& health);

}  // namespace terracut::cli
