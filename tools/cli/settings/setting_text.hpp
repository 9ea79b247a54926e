// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rt/error.hpp"
#include "setting.hpp"

namespace terracut::cli {

/// Returns the placeholder of a setting's text in help: "ADDRESS", "TEXT".
[[nodiscard]] std::string_view form_name(const Setting& setting);

/// Returns the valid values of a setting: "0.2 .. 6", "auto, hdl64e, ruby128", "file or folder".
[[nodiscard]] std::string allowed_text(const Setting& setting);

/// Sets one setting from text; to a list the text is added. Relative paths start at `base`. The
/// error, kInvalidArgument, tells what was expected and found, without the setting's name.
[[nodiscard]] Status apply_text(const Setting& setting, std::string_view text,
                                const std::filesystem::path& base, Options& options);

/// Returns a setting's value in the form that apply_text() takes; empty if not given.
[[nodiscard]] std::string value_text(const Setting& setting, const Options& options);

}  // namespace terracut::cli
