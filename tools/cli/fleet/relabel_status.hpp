// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>

#include "rt/error.hpp"

namespace terracut::cli {

/// Returns several lines for people about the newest job in a folder of `terracut relabel`: what is
/// done, missing or failed and why, speed and expected end, and the command for the missing drives.
/// Fails with kNotFound if there is no job, else kMalformed.
[[nodiscard]] Expected<std::string> relabel_status(const std::filesystem::path& folder);

}  // namespace terracut::cli
