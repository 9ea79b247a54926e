// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "rt/error.hpp"
#include "tools/research/baselines/method_config.hpp"

namespace terracut::eval {

/// A method that can be chosen by name.
struct MethodChoice {
  std::string name;   ///< "terracut"; a variant has its own name.
  std::string about;  ///< Description for reports: "Ring-based elevation map"
  std::string base;   ///< The name among baselines::method_names(); equal without a variant.
  baselines::MethodConfig config;
};

/// Returns one of baselines::method_names(). Fails with kInvalidArgument, naming them, for any
/// other name.
[[nodiscard]] Expected<MethodChoice> method_named(std::string_view name);

/// Returns a variant: a method under a name of its own with other parameters,
/// "no_bands=terracut,grid.max_band_m=1e9". `settings`, KEY=VALUE each, are applied before its own.
/// Fails with kInvalidArgument for an invalid form, method, parameter or value, for a parameter of
/// another method, and for a name that is a method's or has characters other than letters, digits,
/// `_` and `-`.
[[nodiscard]] Expected<MethodChoice> method_variant(std::string_view text,
                                                    std::span<const std::string> settings);

}  // namespace terracut::eval
