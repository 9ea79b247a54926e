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

/// Every parameter of the method, grouped by stage in the order the stages run.
[[nodiscard]] std::span<const Parameter> parameters() noexcept;

/// Those of its baselines (pipeline/baselines/), grouped by method: "pfaff.cell_m".
[[nodiscard]] std::span<const Parameter> baseline_parameters() noexcept;

/// Sets one parameter, a baseline's included, from text ("0.2", "local_surface"). The error names
/// the key, the value and what would have been valid; for an unknown key, the keys of the same
/// stage.
[[nodiscard]] Status set_parameter(MethodConfig& config, std::string_view key,
                                   std::string_view value);

/// The same from "KEY=VALUE".
[[nodiscard]] Status apply_setting(MethodConfig& config, std::string_view setting);

/// The kind of method that looks at a parameter of parameters() or baseline_parameters(); for the
/// others it changes nothing.
[[nodiscard]] MethodKind kind_that_uses(std::string_view key) noexcept;

/// A parameter's value as set_parameter() takes it.
[[nodiscard]] std::string value_text(const Parameter& parameter, const MethodConfig& config);

}  // namespace terracut::ground
