// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "rt/files/owned_descriptor.hpp"

namespace terracut::files {

/// A file or folder that is being written as "PLACE.part-PID-N", beside the place it will take. Its
/// maker holds a lock (flock) on this part, which the kernel releases however the process ends: so
/// a part being written is told from one that a killed process left, even between containers.
struct Part {
  std::filesystem::path path;
  OwnedDescriptor lock;  ///< The open file or folder; empty if making it failed (see errno).
};

/// Makes an empty part file, open for writing and reading; all may read it as far as the umask
/// allows.
[[nodiscard]] Part make_part_file(const std::filesystem::path& place);
/// Makes an empty part folder, which only this user may use.
[[nodiscard]] Part make_part_folder(const std::filesystem::path& place);

/// True if `place` has a part beside it, being written or abandoned.
[[nodiscard]] bool has_part(const std::filesystem::path& place);

/// Removes the abandoned parts in `folder` that belong to this user, if `is_wanted` accepts the
/// file name of the part's place. Parts that cannot be removed stay.
void remove_abandoned_parts(const std::filesystem::path& folder,
                            const std::function<bool(std::string_view)>& is_wanted);

}  // namespace terracut::files
