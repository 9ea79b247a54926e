// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "rt/error.hpp"

namespace terracut::cli {

/// The folder of a drive's labels, which is whole or not there. In it are
///
///   NNNNNN.label    or returns.parquet, returns.mcap
///   terracut.json   what its name is a hash of, what came out, and of how many files and bytes
///   terracut.yaml   the settings
///   SHA256SUMS      of all these, for `sha256sum -c`
///
/// The bytes in it depend on nothing but what it is named by.

inline constexpr std::string_view kDriveFacts = "terracut.json";
inline constexpr std::string_view kDriveSums = "SHA256SUMS";

/// What terracut.json says of a folder whose files are as many and as long as it says; null where
/// that is not so. Reads no labels: what changed in them without a change of length is for
/// `sha256sum -c` to find.
[[nodiscard]] nlohmann::ordered_json facts_of_whole(const std::filesystem::path& folder);

/// Makes a folder of finished files whole: writes `facts` with the number and the length of the
/// files, and the sums, and waits until all of it is on the disk. kWriteFailed, kUnreadable.
[[nodiscard]] Status seal(const std::filesystem::path& folder, nlohmann::ordered_json facts);

/// Renames a sealed folder to its place. Where a whole one has come there meanwhile, that one
/// stays; one that is not whole goes into `folder`'s parent. kWriteFailed.
[[nodiscard]] Status put_in_place(const std::filesystem::path& folder,
                                  const std::filesystem::path& place);

}  // namespace terracut::cli
