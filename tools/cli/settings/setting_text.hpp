// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rt/error.hpp"
#include "setting.hpp"

namespace terracut::cli {

/// What stands for a text of its form in help: "ADDRESS", "TEXT".
[[nodiscard]] std::string_view form_name(const Setting& setting);

/// What is valid for a setting: "0.2 .. 6", "auto, hdl64e, ruby128", "file or folder".
[[nodiscard]] std::string allowed_text(const Setting& setting);

/// Sets one setting from text; of a list, adds to it. Relative paths are taken from `base`. The
/// error, kInvalidArgument, says what was expected and what was found, without the setting's name.
[[nodiscard]] Status apply_text(const Setting& setting, std::string_view text,
                                const std::filesystem::path& base, Options& options);

/// A setting's value as apply_text() takes it; empty: not given.
[[nodiscard]] std::string value_text(const Setting& setting, const Options& options);

}  // namespace terracut::cli
