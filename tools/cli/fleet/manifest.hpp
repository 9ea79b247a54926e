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

/// A recording to be labelled. Empty paths mean there is no such file.
struct FleetDrive {
  std::string name;               ///< Unique: its path below the root, "2026-11-02/front".
  std::filesystem::path capture;  ///< A pcap or pcapng file; empty for clouds.
  std::filesystem::path scans;    ///< A folder of clouds; empty for a capture.
  std::filesystem::path calibration, setup;
  std::filesystem::path can, dbc;      ///< Recording of the vehicle's bus, and its DBC file.
  std::vector<std::string> arguments;  ///< Further options of `replay` or `segment` for this drive.
  std::uint64_t bytes = 0;             ///< Of the capture or the clouds; balances the shards.

  [[nodiscard]] const std::filesystem::path& input() const noexcept {
    return capture.empty() ? scans : capture;
  }
};

/// The recordings of a fleet. Its JSON file has
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

/// Reads a manifest; paths become absolute. Errors name the file and the fault: kNotFound,
/// kUnreadable, kMalformed.
[[nodiscard]] Expected<Manifest> read_manifest(const std::filesystem::path& path);

/// Writes a manifest, with paths below the root relative to it. Whole or not at all.
[[nodiscard]] Status write_manifest(const std::filesystem::path& path, const Manifest& manifest);

/// One of several parts of a manifest.
struct Shard {
  std::size_t number = 1, of = 1;  ///< 1 <= number <= of
};

/// Parses "3/12". kInvalidArgument.
[[nodiscard]] Expected<Shard> parse_shard(std::string_view text);

/// Returns the shard's drives, the largest first. Every drive is in one shard, shards are balanced
/// by bytes (the largest drive goes to the emptiest shard), and the same manifest always gives the
/// same result.
[[nodiscard]] std::vector<FleetDrive> drives_of(const Manifest& manifest, const Shard& shard);

}  // namespace terracut::cli
