// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::files {

/// Opens a file for reading that others may have put there: a named pipe, which would make the
/// reader wait, or a device, which has no end, is refused. Links are followed. kNotFound,
/// kUnreadable.
[[nodiscard]] Expected<OwnedDescriptor> open_plain_file(const std::filesystem::path& path);

/// kUnreadable for a pipe, a socket or a device, which cannot be read a second time; nothing else
/// is looked at, and nothing opened. Links are followed.
[[nodiscard]] Status check_readable_twice(const std::filesystem::path& path);

/// All that is in such a file. kUnreadable, too, where it holds more than `most_bytes`.
[[nodiscard]] Expected<std::string> read_plain_file(const std::filesystem::path& path,
                                                    std::size_t most_bytes);

}  // namespace terracut::files
