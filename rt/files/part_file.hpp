// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "rt/files/owned_descriptor.hpp"

namespace terracut::files {

/// A file or folder being written beside the place it will take, "PLACE.part-PID-N". Its maker
/// holds a lock on it (flock), which the kernel releases however the process ends: so a part being
/// written is told from one that a killed process left, even between containers.
struct Part {
  std::filesystem::path path;
  OwnedDescriptor lock;  ///< The open file or folder; empty if making it failed (see errno).
};

/// Makes an empty file, open for writing and reading, readable for all as far as the umask allows.
[[nodiscard]] Part make_part_file(const std::filesystem::path& place);
/// Makes an empty folder, for this user alone.
[[nodiscard]] Part make_part_folder(const std::filesystem::path& place);

/// True if a part of that place lies beside it, being written or abandoned.
[[nodiscard]] bool has_part(const std::filesystem::path& place);

/// Removes the abandoned parts in `folder` that belong to this user. `is_wanted` is asked about the
/// file name of each part's place. Parts that cannot be removed stay.
void remove_abandoned_parts(const std::filesystem::path& folder,
                            const std::function<bool(std::string_view)>& is_wanted);

}  // namespace terracut::files
