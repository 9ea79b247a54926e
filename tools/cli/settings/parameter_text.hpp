// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "pipeline/ground/parameter.hpp"

namespace terracut::cli {

/// Returns "0.01 .. 2", "0 .. no limit", "auto, all, ground".
[[nodiscard]] std::string range_text(const ground::ParameterText& parameter);

/// Returns a value of a parameter for people: "0.15", "no limit".
[[nodiscard]] std::string shown_value(const ground::ParameterText& parameter, double value);

}  // namespace terracut::cli
