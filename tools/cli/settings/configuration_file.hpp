// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Reads a configuration file: YAML with sections of keys as in settings(), and the method's
/// parameters by stage under `method`. A key that is left out keeps its default. Relative paths
/// start at the file's folder.
///
/// Errors name file and line. Fails with kMalformed for invalid YAML, an unknown or repeated key, a
/// value of the wrong kind or out of range; otherwise with the errors of
/// calib/text/bounded_file.hpp.
[[nodiscard]] Expected<Options> read_configuration(const std::filesystem::path& path);

/// Reads a configuration from text; `name` stands for the file in messages, `base` for its folder.
[[nodiscard]] Expected<Options> parse_configuration(std::string_view text, const std::string& name,
                                                    const std::filesystem::path& base);

}  // namespace terracut::cli
