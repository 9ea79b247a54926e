// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "manifest.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// A manifest to be labelled by one program with one set of settings into one folder. Any number of
/// processes may work on a job. Their shared state lies in the folder's .relabel:
///
///   ID/job.json           manifest, drives and their bytes, program, when it began
///   ID/terracut.yaml      the settings
///   ID/records/           a file for each drive that says what became of it (relabel_record.hpp)
///   parts/                a folder for each drive under way, used by one process alone
///   broken/               drives' folders that were not whole, with all that was in them
struct RelabelJob {
  std::filesystem::path folder;    ///< Folder that holds the drives' folders.
  std::filesystem::path manifest;  ///< Absolute path.
  std::string id;                  ///< A hash of manifest, program and settings.
  std::string program;             ///< SHA-256 of the executable.
  std::string settings;            ///< Settings, as text of a configuration file.
  FleetFormat format = FleetFormat::kLabels;
  std::string host;

  [[nodiscard]] std::filesystem::path parts() const { return folder / ".relabel" / "parts"; }
  [[nodiscard]] std::filesystem::path broken() const { return folder / ".relabel" / "broken"; }
  [[nodiscard]] std::filesystem::path state() const { return folder / ".relabel" / id; }
  /// Returns the beginning "HASH@ID@" of the names of a drive's parts, the same on any host.
  [[nodiscard]] std::string part_prefix(const FleetDrive& drive) const;
};

/// Writes job.json and terracut.yaml unless the job exists. Fails if this program's file cannot be
/// read or a file cannot be written.
[[nodiscard]] Expected<RelabelJob> begin_job(const Options& options, const Manifest& manifest);

inline constexpr std::string_view kJobSettings = "terracut.yaml";

/// A job as its folder describes it.
struct KnownJob {
  struct Drive {
    std::string name;
    std::uint64_t bytes = 0;
  };
  std::filesystem::path state;  ///< The job's folder.
  std::filesystem::path manifest;
  std::string version;  ///< Version of terracut.
  std::int64_t began_ns = 0;
  std::vector<Drive> drives;
};
/// Reads a job. Fails with kNotFound, kUnreadable, or kMalformed for an invalid job.json.
[[nodiscard]] Expected<KnownJob> read_job(const std::filesystem::path& state);
/// Returns the jobs that have labelled into a folder, in order of their start; invalid ones are
/// left out. Fails with kNotFound if there is no job.
[[nodiscard]] Expected<std::vector<KnownJob>> jobs_in(const std::filesystem::path& folder);

/// Returns the arguments with which `terracut replay` or `segment` labels a drive by the settings
/// in that file, without outputs. Fails with kMalformed if an argument in the manifest concerns
/// anything but reading and labelling, or with the errors of the settings.
[[nodiscard]] Expected<std::vector<std::string>> words_for(const FleetDrive& drive,
                                                           const std::filesystem::path& settings);

/// Returns everything that a drive's labels depend on; the name of the drive's folder contains its
/// hash. Fails with the errors of content_of().
[[nodiscard]] Expected<nlohmann::ordered_json> recipe_of(const RelabelJob& job,
                                                         const FleetDrive& drive);

/// Returns the name of a drive's folder, "NAME-0123456789abcdef", below the job's folder.
[[nodiscard]] std::string output_name_of(const FleetDrive& drive,
                                         const nlohmann::ordered_json& recipe);

}  // namespace terracut::cli
