// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "pipeline/ground/parameter_table.hpp"

namespace terracut::cli {

/// "0.01 .. 2", "0 .. no limit", "auto, all, ground".
[[nodiscard]] std::string range_text(const ground::Parameter& parameter);

/// A parameter's value for people: "0.15", "no limit".
[[nodiscard]] std::string shown_value(const ground::Parameter& parameter,
                                      const ground::MethodConfig& config);

}  // namespace terracut::cli
