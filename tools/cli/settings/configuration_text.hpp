// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Returns a configuration file with every key under its description, unit and range. Keys with
/// default values are commented out, so that the file sets only what it changes.
[[nodiscard]] std::string configuration_yaml(const Options& options);

/// Returns the table of docs/reference/configuration.md, in Markdown.
[[nodiscard]] std::string configuration_table();

}  // namespace terracut::cli
