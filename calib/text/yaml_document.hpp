// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <string_view>

#include "rt/error.hpp"

// For .cpp files only, of calib and of tools: no public header includes this one.
namespace terracut::text {

/// Deepest nesting of maps and lists read; calibration and setup files have 3.
inline constexpr int kMaxYamlDepth = 8;
/// Most scalars, maps and lists read; a calibration has some 1800.
inline constexpr int kMaxYamlNodes = 20000;

/// The YAML document in `text`, once it is known to be harmless: not empty, at most kMaxFileBytes,
/// kMaxYamlDepth and kMaxYamlNodes, no aliases (a few lines of which can stand for gigabytes), and
/// the only one. Errors name `name`, the line and what was found. Throws nothing.
[[nodiscard]] Expected<YAML::Node> load_yaml_document(std::string_view text,
                                                      const std::string& name);

/// "NAME: line N" for messages about `node`.
[[nodiscard]] std::string where_is(const YAML::Node& node, const std::string& name);

}  // namespace terracut::text
