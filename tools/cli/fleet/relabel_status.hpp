// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>

#include "rt/error.hpp"

namespace terracut::cli {

/// What is done of the newest job in a folder of `terracut relabel`, what is missing, what failed
/// and why, how fast it goes and when it will end, with the command that does the rest: several
/// lines, for people. kNotFound where there is no job; kMalformed.
[[nodiscard]] Expected<std::string> relabel_status(const std::filesystem::path& folder);

}  // namespace terracut::cli
