// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "rt/files/owned_descriptor.hpp"

namespace terracut::files {

/// A file or folder that is being written under the name "PLACE.part-PID-N", beside its final path
/// PLACE. Its maker holds a lock (flock) on it, which the kernel releases however the process ends.
/// So a part being written can be told from one that a killed process left, even between
/// containers.
struct Part {
  std::filesystem::path path;
  OwnedDescriptor lock;  ///< The open file or folder; empty if making it failed (see errno).
};

/// Makes an empty part file, open for writing and reading; all may read it as far as the umask
/// allows.
[[nodiscard]] Part make_part_file(const std::filesystem::path& place);
/// Makes an empty part folder, which only this user may use.
[[nodiscard]] Part make_part_folder(const std::filesystem::path& place);

/// True if there is a part for the final path `place`, being written or abandoned.
[[nodiscard]] bool has_part(const std::filesystem::path& place);

/// Removes the abandoned parts in `folder` that belong to this user and whose final file name
/// `is_wanted` accepts. Parts that cannot be removed stay.
void remove_abandoned_parts(const std::filesystem::path& folder,
                            const std::function<bool(std::string_view)>& is_wanted);

}  // namespace terracut::files
