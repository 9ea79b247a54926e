// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "tools/cli/options.hpp"

namespace terracut::cli {

/// A configuration file with every key under its description, unit and range. Keys that have their
/// default are comments, so that the file says only what it changes.
[[nodiscard]] std::string configuration_yaml(const Options& options);

/// The table of docs/reference/configuration.md, in Markdown.
[[nodiscard]] std::string configuration_table();

}  // namespace terracut::cli
