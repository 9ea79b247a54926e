// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace terracut::cli {

/// What looks like a recording, or might hold some, and is not to be labelled.
struct LeftOut {
  std::filesystem::path path;
  std::string why;  ///< And what to do about it; the same for those of a kind.
};

/// The recordings in a tree of folders.
struct RecordingTree {
  std::set<std::filesystem::path> captures;
  std::map<std::filesystem::path, std::uint64_t> clouds;  ///< Folders, and the bytes of clouds in.
  std::vector<LeftOut> left_out;                          ///< By path.
};

/// Looks through all of `root`, a canonical path. Captures are known by their names
/// (capture::capture_stem) or first bytes, clouds by their names. Links are followed: to a folder
/// only where it is not found without them, nor by another link, nor is `root` in it, so that there
/// are no loops and nothing is there twice. Passed over are names that begin with a dot, and
/// folders that file servers keep for themselves (@eaDir). Left out is what cannot be opened, what
/// is packed or of a kind that is not read here, and what a manifest cannot name, for it is no
/// UTF-8.
[[nodiscard]] RecordingTree find_recordings(const std::filesystem::path& root);

}  // namespace terracut::cli
