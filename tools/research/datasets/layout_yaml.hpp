// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "cloud_layout.hpp"
#include "rt/error.hpp"

// For .cpp files of this folder only: yaml-cpp stays out of what others include.
namespace terracut::datasets {

/// kMalformed, with the line in `name`: a key that is unknown, missing or has no such value, or a
/// combination that no file can have.
[[nodiscard]] Expected<CloudLayout> layout_from_yaml(const YAML::Node& node,
                                                     const std::string& name);

}  // namespace terracut::datasets
