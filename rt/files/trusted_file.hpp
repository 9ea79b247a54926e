// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include <filesystem>

#include "rt/error.hpp"

namespace terracut::files {

/// True if a reader may trust files of `owner` in a folder that everybody may write to. Trusted are
/// the reader, root, and services, whose user numbers no person has: below 1000, and 61184 to
/// 65519, which systemd gives to DynamicUser=.
[[nodiscard]] bool is_trusted_owner(::uid_t owner, ::uid_t reader) noexcept;

/// Checks that an open file is a plain file of a trusted owner and that nobody else may write to
/// it. Fails with kUnreadable; the message names the fault.
[[nodiscard]] Status check_trusted(const struct ::stat& file, const std::filesystem::path& path);

}  // namespace terracut::files
