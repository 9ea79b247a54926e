// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <CLI/CLI.hpp>

#include <string_view>

namespace terracut::cli {

/// A number in [low, high]. Unlike CLI::Range it lets no NaN through.
[[nodiscard]] CLI::Validator number(double low, double high);

/// What the configuration file allows for the same: the range of a key, or its words.
[[nodiscard]] CLI::Validator range_of(std::string_view key);
[[nodiscard]] CLI::IsMember one_of(std::string_view key);

}  // namespace terracut::cli
