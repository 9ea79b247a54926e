// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Reads a configuration file: YAML, sections of keys as settings() has them, and under `method`
/// the parameters of the method by stage. A key that is left out keeps its default. Relative paths
/// are taken from the file's folder.
///
/// Errors, with the file and the line: kMalformed for what is not YAML, an unknown or repeated key,
/// a value of the wrong kind or out of its range; otherwise those of calib/text/bounded_file.hpp.
[[nodiscard]] Expected<Options> read_configuration(const std::filesystem::path& path);

/// The same for text that is at hand; `name` stands for the file in messages, `base` for its
/// folder.
[[nodiscard]] Expected<Options> parse_configuration(std::string_view text, const std::string& name,
                                                    const std::filesystem::path& base);

}  // namespace terracut::cli
