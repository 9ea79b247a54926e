// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string_view>

#include "method_config.hpp"
#include "pipeline/ground/parameter.hpp"
#include "rt/error.hpp"

namespace terracut::baselines {

using Parameter = ground::ParameterOf<MethodConfig>;

/// Returns all parameters of the baselines, by method: "pfaff.cell_m".
[[nodiscard]] std::span<const Parameter> parameters() noexcept;

/// Sets a parameter of a baseline or of our method, as ground::apply_setting() does for ours.
[[nodiscard]] Status apply_setting(MethodConfig& config, std::string_view setting);

/// Returns the kind of method that uses a parameter. The parameter has no effect on other kinds.
[[nodiscard]] MethodKind kind_that_uses(std::string_view key) noexcept;

}  // namespace terracut::baselines
