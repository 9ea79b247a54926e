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

/// A path that looks like a recording, or might contain some, but is not to be labelled.
struct LeftOut {
  std::filesystem::path path;
  std::string why;  ///< Reason and remedy; same text for all of a kind.
};

/// The recordings in a tree of folders.
struct RecordingTree {
  std::set<std::filesystem::path> captures;
  std::map<std::filesystem::path, std::uint64_t> clouds;  ///< Folder: bytes of its clouds.
  std::set<std::filesystem::path> bags;                   ///< Of packets or of clouds.
  std::vector<LeftOut> left_out;                          ///< Ordered by path.
};

/// Searches all of `root`, a canonical path. Captures are recognised by their names
/// (capture::capture_stem) or first bytes, clouds by their names, bags by first bytes or, if a folder,
/// by their metadata.yaml. A link to a folder is followed
/// only if the folder does not contain `root` and is not found in any other way, so there are no
/// loops and no duplicates. Skipped are names that begin with a dot and folders that file servers
/// keep for their own use (@eaDir). Left out, with a reason, are paths that cannot be opened,
/// packed or unsupported files, and names that are not UTF-8, which a manifest cannot hold.
[[nodiscard]] RecordingTree find_recordings(const std::filesystem::path& root);

}  // namespace terracut::cli
