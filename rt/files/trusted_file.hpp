// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include <filesystem>

#include "rt/error.hpp"

namespace terracut::files {

/// True if files of `owner` in a folder that everybody may write to can be believed: the owner is
/// the reader, root, or a service, whose numbers no person has (below 1000, or 61184 to 65519,
/// which systemd gives to DynamicUser=).
[[nodiscard]] bool is_trusted_owner(::uid_t owner, ::uid_t reader) noexcept;

/// Checks that an open file is a plain one of a trusted owner and that nobody else may write to it.
/// kUnreadable names the fault.
[[nodiscard]] Status check_trusted(const struct ::stat& file, const std::filesystem::path& path);

}  // namespace terracut::files
