// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rt/error.hpp"
#include "tools/cli/input/recording_tree.hpp"

namespace terracut::cli {

/// A recording to be labelled. Empty paths: there is none of that.
struct FleetDrive {
  std::string name;               ///< Unique; its place below the root, "2026-11-02/front".
  std::filesystem::path capture;  ///< pcap or pcapng, or
  std::filesystem::path scans;    ///< a folder of clouds.
  std::filesystem::path calibration, setup;
  std::filesystem::path can, dbc;      ///< Recording of the vehicle's bus, and what it means.
  std::vector<std::string> arguments;  ///< More options of `replay` or `segment`, for it alone.
  std::uint64_t bytes = 0;             ///< Of the capture or the clouds; by it shards are balanced.

  [[nodiscard]] const std::filesystem::path& input() const noexcept {
    return capture.empty() ? scans : capture;
  }
};

/// The recordings of a fleet. As a file, JSON:
///
///   manifest   1, the version of this layout
///   root       folder that paths are taken from; a relative one from the manifest's folder
///   drives[]   the members of FleetDrive by their names; those that are empty are left out
///   left_out[] path and why of what looks like a recording and is no drive; for people
struct Manifest {
  std::filesystem::path root;
  std::vector<FleetDrive> drives;
  std::vector<LeftOut> left_out{};  ///< Not read back.
};

/// With absolute paths. Errors name the file and what is wrong in it: kNotFound, kUnreadable,
/// kMalformed.
[[nodiscard]] Expected<Manifest> read_manifest(const std::filesystem::path& path);

/// Paths below the root become relative to it. Whole or not at all.
[[nodiscard]] Status write_manifest(const std::filesystem::path& path, const Manifest& manifest);

/// One of several parts of a manifest.
struct Shard {
  std::size_t number = 1, of = 1;  ///< 1 <= number <= of
};

/// "3/12". kInvalidArgument.
[[nodiscard]] Expected<Shard> parse_shard(std::string_view text);

/// Its drives, the greatest first. Every drive is in one shard, shards differ in bytes by no more
/// than their smallest drive allows (the greatest drive goes to the emptiest shard), and the same
/// manifest always gives the same.
[[nodiscard]] std::vector<FleetDrive> drives_of(const Manifest& manifest, const Shard& shard);

}  // namespace terracut::cli
