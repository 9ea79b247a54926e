// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string_view>

#include "rt/error.hpp"

namespace terracut::vehicle {

/// Metres a second in one `unit`: "m/s", "km/h" or "mph", and the other spellings that DBC files
/// have of them ("kph", "KPH", "mi/h" and so on). kInvalidArgument, naming the unit, for others.
[[nodiscard]] Expected<double> metres_per_second_in(std::string_view unit);

/// Radians a second in one `unit`: "rad/s" or "deg/s", and their other spellings ("°/s").
[[nodiscard]] Expected<double> radians_per_second_in(std::string_view unit);

}  // namespace terracut::vehicle
