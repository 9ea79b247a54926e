// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string_view>

#include "rt/error.hpp"

namespace terracut::vehicle {

/// Returns the metres a second of one `unit`: "m/s", "km/h" or "mph", and their other spellings in
/// DBC files ("kph", "KPH", "mi/h" and so on). Fails with kInvalidArgument, naming the unit, for
/// others.
[[nodiscard]] Expected<double> metres_per_second_in(std::string_view unit);

/// Returns the radians a second of one `unit`: "rad/s" or "deg/s", and their other spellings
/// ("°/s").
[[nodiscard]] Expected<double> radians_per_second_in(std::string_view unit);

}  // namespace terracut::vehicle
