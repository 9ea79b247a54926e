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

/// Every parameter of the baselines, grouped by method: "pfaff.cell_m".
[[nodiscard]] std::span<const Parameter> parameters() noexcept;

/// As ground::apply_setting(), of a baseline's parameter or of our method's.
[[nodiscard]] Status apply_setting(MethodConfig& config, std::string_view setting);

/// The kind of method that looks at a parameter, a baseline's or ours; for the others it changes
/// nothing.
[[nodiscard]] MethodKind kind_that_uses(std::string_view key) noexcept;

}  // namespace terracut::baselines
