// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::files {

/// Opens a plain file for reading. Refuses a named pipe, which would make the reader wait, and a
/// device, which has no end. Links are followed. kNotFound, kUnreadable.
[[nodiscard]] Expected<OwnedDescriptor> open_plain_file(const std::filesystem::path& path);

/// Refuses what cannot be read a second time, a pipe, a socket or a device, with kUnreadable. Opens
/// nothing and checks nothing else. Links are followed.
[[nodiscard]] Status check_readable_twice(const std::filesystem::path& path);

/// Returns the whole content of a plain file. kUnreadable also if it holds more than `most_bytes`.
[[nodiscard]] Expected<std::string> read_plain_file(const std::filesystem::path& path,
                                                    std::size_t most_bytes);

}  // namespace terracut::files
