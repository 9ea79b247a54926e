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

/// A recording to be labelled. An empty path means that there is no such file.
struct FleetDrive {
  std::string name;               ///< Unique path below the root, "2026-11-02/front".
  std::filesystem::path capture;  ///< A pcap or pcapng file, or a bag; empty for clouds.
  std::filesystem::path scans;    ///< A folder of clouds, or a bag; empty for a capture.
  std::filesystem::path calibration, setup;
  std::filesystem::path can, dbc;      ///< CAN recording of the vehicle, and its DBC file.
  std::vector<std::string> arguments;  ///< More options of `replay` or `segment` for it.
  std::uint64_t bytes = 0;             ///< Bytes of the capture or clouds; balances shards.

  [[nodiscard]] const std::filesystem::path& input() const noexcept {
    return capture.empty() ? scans : capture;
  }
};

/// The recordings of a fleet. The manifest's JSON file has
///
///   manifest   1, the version of this layout
///   root       folder that paths are taken from; a relative one from the manifest's folder
///   drives[]   the members of FleetDrive by their names; those that are empty are left out
///   left_out[] path and why of what looks like a recording and is no drive; for people
struct Manifest {
  std::filesystem::path root;
  std::vector<FleetDrive> drives;
  std::vector<LeftOut> left_out{};  ///< Written only, not read back.
};

/// Reads a manifest; paths become absolute. Fails with kNotFound, kUnreadable or kMalformed; the
/// message names the file and the fault.
[[nodiscard]] Expected<Manifest> read_manifest(const std::filesystem::path& path);

/// Writes a manifest, whole or not at all; paths below the root are written relative to it.
[[nodiscard]] Status write_manifest(const std::filesystem::path& path, const Manifest& manifest);

/// One of the parts into which a manifest is divided.
struct Shard {
  std::size_t number = 1, of = 1;  ///< 1 <= number <= of
};

/// Parses a shard such as "3/12". Fails with kInvalidArgument.
[[nodiscard]] Expected<Shard> parse_shard(std::string_view text);

/// Returns the shard's drives, the largest first. Every drive is in one shard; shards are balanced
/// by bytes (the largest drive left goes to the emptiest shard); the same manifest always gives the
/// same shards.
[[nodiscard]] std::vector<FleetDrive> drives_of(const Manifest& manifest, const Shard& shard);

}  // namespace terracut::cli
