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

/// The folder of a drive's labels, which is whole or not there. In it are
///
///   NNNNNN.label    or returns.mcap
///   terracut.json   what its name is a hash of, what came out, and of how many files and bytes
///   terracut.yaml   the settings
///   SHA256SUMS      of all these, for `sha256sum -c`
///
/// The bytes of these depend on nothing but what the folder is named by. What SHA256SUMS does not
/// list is somebody's own: it neither counts nor is it ever removed.

inline constexpr std::string_view kDriveFacts = "terracut.json";
inline constexpr std::string_view kDriveSums = "SHA256SUMS";

/// What terracut.json says of a folder in which the files that SHA256SUMS lists are there, as many
/// and as long as it says; null where that is not so. Its figures are whole numbers then. Reads no
/// labels: what changed in them without a change of length is for `sha256sum -c` to find.
[[nodiscard]] nlohmann::ordered_json facts_of_whole(const std::filesystem::path& folder);

/// Makes a folder of finished files whole: writes `facts` with the number and the length of the
/// files, and the sums, and waits until all of it is on the disk. kWriteFailed, kUnreadable.
[[nodiscard]] Status seal(const std::filesystem::path& folder, nlohmann::ordered_json facts);

/// The files that a folder's SHA256SUMS lists, with their sums, in the order of their names; none
/// where it cannot be read or is none.
[[nodiscard]] std::map<std::string, std::string> listed_sums(const std::filesystem::path& folder);

/// Whether a folder can come to lie at `place`, before the work: makes the folders above it.
/// kWriteFailed where none could be written anywhere there, for the disk is full, read only or
/// broken; kInvalidArgument where it is this place alone.
[[nodiscard]] Status check_place(const std::filesystem::path& place);

/// Renames a sealed folder to its place. Where a whole one has come there meanwhile, that one
/// stays; one that is not whole is kept as `broken`.N, whose path is returned (else an empty one).
/// The errors of check_place().
[[nodiscard]] Expected<std::filesystem::path> put_in_place(const std::filesystem::path& folder,
                                                           const std::filesystem::path& place,
                                                           const std::filesystem::path& broken);

}  // namespace terracut::cli
