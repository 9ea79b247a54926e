// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "configuration.hpp"

namespace terracut::cli {

/// A configuration file with every key under its description, unit and range. Keys that have their
/// default are comments, so that the file says only what it changes.
[[nodiscard]] std::string configuration_yaml(const Configuration& configuration);

/// The table of docs/configuration.md, in Markdown.
[[nodiscard]] std::string configuration_table();

}  // namespace terracut::cli
