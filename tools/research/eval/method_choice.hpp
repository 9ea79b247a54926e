// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "rt/error.hpp"
#include "tools/research/baselines/method_config.hpp"

namespace terracut::eval {

/// A way of labelling that can be chosen by name.
struct MethodChoice {
  std::string name;   ///< "terracut"; of a variant its own.
  std::string about;  ///< For reports: "Ring-based elevation map"
  std::string base;   ///< The name among baselines::method_names(); without a variant the same.
  baselines::MethodConfig config;
};

/// One of baselines::method_names(); kInvalidArgument, naming them, for any other name.
[[nodiscard]] Expected<MethodChoice> method_named(std::string_view name);

/// A method under a name of its own with other parameters: "no_bands=terracut,grid.max_band_m=1e9".
/// `settings`, KEY=VALUE each, are made before its own. kInvalidArgument: no such form, method,
/// parameter or value; a name that is a method's or not of letters, digits, `_` and `-`; a
/// parameter of another method.
[[nodiscard]] Expected<MethodChoice> method_variant(std::string_view text,
                                                    std::span<const std::string> settings);

}  // namespace terracut::eval
