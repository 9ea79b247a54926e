// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string_view>

#include "pipeline/ground/parameter.hpp"
#include "pipeline/ground/profile.hpp"
#include "rt/error.hpp"

namespace terracut::ground {

using Parameter = ParameterOf<SegmenterConfig>;

/// Returns all parameters of the method by stage, in the order in which the stages run.
/// docs/reference/parameters.md is printed from this table.
[[nodiscard]] std::span<const Parameter> parameters() noexcept;

/// True if the method with `config` reads the parameter; some parameters belong to a rule that may
/// be switched off.
[[nodiscard]] bool is_read(const Parameter& parameter, const SegmenterConfig& config) noexcept;

/// Sets one parameter from text ("0.2", "local_surface"). The error's message names the key, the
/// value and the valid values, or, for an unknown key, the keys of the same stage.
[[nodiscard]] Status set_parameter(SegmenterConfig& config, std::string_view key,
                                   std::string_view value);

/// Sets a parameter from the text "KEY=VALUE".
[[nodiscard]] Status apply_setting(SegmenterConfig& config, std::string_view setting);

}  // namespace terracut::ground
