// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "cloud_layout.hpp"
#include "rt/error.hpp"

// Only for .cpp files of this folder, so that no other file includes yaml-cpp.
namespace terracut::datasets {

/// Reads a layout. Fails with kMalformed, naming the line in `name`, for an unknown or missing key,
/// an invalid value, or an impossible combination.
[[nodiscard]] Expected<CloudLayout> layout_from_yaml(const YAML::Node& node,
                                                     const std::string& name);

}  // namespace terracut::datasets
