// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>

#include "pipeline/ground_method.hpp"
#include "rt/error.hpp"

namespace terracut::evaluation {

/// A way of labelling that can be chosen by name.
struct MethodChoice {
  std::string name;   ///< "terracut"
  std::string about;  ///< For reports: "Ring-based elevation map"
  pipeline::MethodConfig config;
};

/// One of pipeline::method_names(); kInvalidArgument, naming them, for any other name.
[[nodiscard]] Expected<MethodChoice> method_named(std::string_view name);

}  // namespace terracut::evaluation
