// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <string_view>

#include "rt/error.hpp"

// For .cpp files of calib and of tools only: no public header includes this one.
namespace terracut::text {

/// Deepest nesting of maps and lists accepted; calibration and setup files have 3 levels.
inline constexpr int kMaxYamlDepth = 8;
/// Most scalars, maps and lists accepted; a calibration has about 1800.
inline constexpr int kMaxYamlNodes = 20000;

/// Parses the YAML document in `text` after checking that it is harmless: not empty, at most
/// kMaxFileBytes, kMaxYamlDepth and kMaxYamlNodes, no aliases (a few lines of which can stand for
/// gigabytes), and only one document. The error names `name`, the line and what was found. Throws
/// nothing.
[[nodiscard]] Expected<YAML::Node> load_yaml_document(std::string_view text,
                                                      const std::string& name);

/// Returns "NAME: line N" for messages about `node`.
[[nodiscard]] std::string where_is(const YAML::Node& node, const std::string& name);

}  // namespace terracut::text
