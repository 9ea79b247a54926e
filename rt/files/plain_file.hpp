// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::files {

/// Opens a plain file for reading. Fails with kNotFound if it is missing, kUnreadable if it cannot
/// be opened or is a named pipe (the reader would wait) or a device (it has no end). Links are
/// followed.
[[nodiscard]] Expected<OwnedDescriptor> open_plain_file(const std::filesystem::path& path);

/// Fails with kUnreadable if the path is a pipe, a socket or a device, none of which can be read a
/// second time. Opens nothing and checks nothing else. Links are followed.
[[nodiscard]] Status check_readable_twice(const std::filesystem::path& path);

/// Returns the whole content of a plain file. Fails as open_plain_file() does, and with kUnreadable
/// if the file holds more than `most_bytes`.
[[nodiscard]] Expected<std::string> read_plain_file(const std::filesystem::path& path,
                                                    std::size_t most_bytes);

}  // namespace terracut::files
