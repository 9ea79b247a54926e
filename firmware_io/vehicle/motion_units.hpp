// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string_view>

#include "rt/error.hpp"

namespace terracut::vehicle {

/// Returns how many metres per second one `unit` is: "m/s", "km/h" or "mph", or another of their
/// spellings in DBC files ("kph", "KPH", "mi/h" and so on). Fails with kInvalidArgument, naming the
/// unit, for others.
[[nodiscard]] Expected<double> metres_per_second_in(std::string_view unit);

/// Returns how many radians per second one `unit` is: "rad/s" or "deg/s", or another of their
/// spellings ("°/s").
[[nodiscard]] Expected<double> radians_per_second_in(std::string_view unit);

}  // namespace terracut::vehicle
