// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "pipeline/ground/ground_method.hpp"
#include "rt/error.hpp"

namespace terracut::ground {

/// One parameter of the method or of a baseline, as users name it (docs/reference/parameters.md is
/// printed from this table).
struct Parameter {
  std::string_view key;   ///< "stage.name_unit"
  std::string_view unit;  ///< "m", "rad", "1/m", ... or empty
  std::string_view help;
  double least = 0, most = 0;                 ///< Valid range, ends included.
  std::span<const std::string_view> choices;  ///< Names of the values 0, 1, ..; empty for a number.
  double (*get)(const MethodConfig&) noexcept = nullptr;
  void (*set)(MethodConfig&, double) noexcept = nullptr;
};

/// Returns every parameter of the method, grouped by stage in the order the stages run.
[[nodiscard]] std::span<const Parameter> parameters() noexcept;

/// Returns the baselines' parameters (pipeline/baselines/), grouped by method: "pfaff.cell_m".
[[nodiscard]] std::span<const Parameter> baseline_parameters() noexcept;

/// Sets one parameter, also of a baseline, from text ("0.2", "local_surface"). The error names the
/// key, the value and valid values; for an unknown key, the keys of the same stage.
[[nodiscard]] Status set_parameter(MethodConfig& config, std::string_view key,
                                   std::string_view value);

/// Sets one parameter from "KEY=VALUE".
[[nodiscard]] Status apply_setting(MethodConfig& config, std::string_view setting);

/// Returns the kind of method that uses a parameter of parameters() or baseline_parameters(); it
/// has no effect on the others.
[[nodiscard]] MethodKind kind_that_uses(std::string_view key) noexcept;

/// Returns a parameter's value as set_parameter() takes it.
[[nodiscard]] std::string value_text(const Parameter& parameter, const MethodConfig& config);

}  // namespace terracut::ground
