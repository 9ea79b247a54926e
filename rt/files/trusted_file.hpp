// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include <filesystem>

#include "rt/error.hpp"

namespace terracut::files {

/// Whether files of `owner` in a folder that everybody may write to say what they seem to: those of
/// the one who reads, of root, and of services, whose numbers no person has (below 1000, or 61184
/// to 65519, which systemd gives to DynamicUser=).
[[nodiscard]] bool is_trusted_owner(::uid_t owner, ::uid_t reader) noexcept;

/// That an open file is a plain one of a trusted owner that nobody else may write to. kUnreadable,
/// naming what is wrong.
[[nodiscard]] Status check_trusted(const struct ::stat& file, const std::filesystem::path& path);

}  // namespace terracut::files
