// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "rt/files/owned_descriptor.hpp"

namespace terracut::files {

/// A file or folder under way beside the place it will take, "PLACE.part-PID-N". Whoever makes one
/// holds a lock on it (flock), which the kernel takes away however the process ends: by that a part
/// under way is told from one that a killed process left, even between containers.
struct Part {
  std::filesystem::path path;
  OwnedDescriptor lock;  ///< The open file, or folder; none: it could not be made, errno says why.
};

/// Makes an empty file, open for writing and reading, and readable for all as far as the umask
/// allows.
[[nodiscard]] Part make_part_file(const std::filesystem::path& place);
/// Makes an empty folder, for this user alone.
[[nodiscard]] Part make_part_folder(const std::filesystem::path& place);

/// Whether a part of that place lies beside it, under way or abandoned.
[[nodiscard]] bool has_part(const std::filesystem::path& place);

/// Removes the parts of places in `folder` that their processes have left, as far as they are this
/// user's. `is_wanted` is asked about the file name of each place. What cannot be removed stays.
void remove_abandoned_parts(const std::filesystem::path& folder,
                            const std::function<bool(std::string_view)>& is_wanted);

}  // namespace terracut::files
