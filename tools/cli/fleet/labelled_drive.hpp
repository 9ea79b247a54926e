// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "rt/error.hpp"

namespace terracut::cli {

/// The folder of a drive's labels, which is complete or missing. Its files are
///
///   NNNNNN.label    or returns.mcap
///   terracut.json   the facts hashed for its name, the results, number and size of files
///   terracut.yaml   the settings
///   SHA256SUMS      of all these, for `sha256sum -c`
///
/// Their content depends only on the facts hashed for the folder's name. A file not listed in
/// SHA256SUMS belongs to somebody else: it is ignored and never removed.

inline constexpr std::string_view kDriveFacts = "terracut.json";
inline constexpr std::string_view kDriveSums = "SHA256SUMS";

/// Returns the facts in terracut.json, or null unless the files in SHA256SUMS are present and their
/// number and total size are those in the facts. Figures in the facts are then whole numbers. Does
/// not read labels: `sha256sum -c` finds changes that keep the length.
[[nodiscard]] nlohmann::ordered_json facts_of_whole(const std::filesystem::path& folder);

/// Completes a folder of finished files: writes `facts` with the number and size of the files, and
/// SHA256SUMS, and waits until all is on the disk. Fails with kWriteFailed or kUnreadable.
[[nodiscard]] Status seal(const std::filesystem::path& folder, nlohmann::ordered_json facts);

/// Returns the files listed in a folder's SHA256SUMS with their sums, in order of names; none if
/// SHA256SUMS is missing or invalid.
[[nodiscard]] std::map<std::string, std::string> listed_sums(const std::filesystem::path& folder);

/// Checks before labelling that a folder can later be put at `place`, and makes the folders above
/// it. Fails with kWriteFailed if nothing can be written there (disk full, read-only or broken),
/// kInvalidArgument if only this path is impossible.
[[nodiscard]] Status check_place(const std::filesystem::path& place);

/// Renames a sealed folder to its place. If a complete folder has appeared there meanwhile, that
/// one stays; an incomplete one is moved to `broken`.N, whose path is returned (otherwise empty).
/// Fails with the errors of check_place().
[[nodiscard]] Expected<std::filesystem::path> put_in_place(const std::filesystem::path& folder,
                                                           const std::filesystem::path& place,
                                                           const std::filesystem::path& broken);

}  // namespace terracut::cli
