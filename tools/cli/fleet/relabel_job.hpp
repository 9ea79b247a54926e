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

/// A manifest labelled by one program with one set of settings, into one folder. Any number of
/// processes may work at it. What they know of it lies in the folder's .relabel:
///
///   ID/job.json           manifest, drives and their bytes, program, when it began
///   ID/terracut.yaml      the settings
///   ID/records/           what became of a drive, a file each (relabel_record.hpp)
///   parts/                what is under way: a folder each, of a process alone
///   broken/               drives' folders that were not whole, and what else was in them
struct RelabelJob {
  std::filesystem::path folder;    ///< Where the drives' folders come to lie.
  std::filesystem::path manifest;  ///< Absolute.
  std::string id;                  ///< A hash of manifest, program and settings.
  std::string program;             ///< SHA-256 of the executable.
  std::string settings;            ///< As a configuration file.
  FleetFormat format = FleetFormat::kLabels;
  std::string host;

  [[nodiscard]] std::filesystem::path parts() const { return folder / ".relabel" / "parts"; }
  [[nodiscard]] std::filesystem::path broken() const { return folder / ".relabel" / "broken"; }
  [[nodiscard]] std::filesystem::path state() const { return folder / ".relabel" / id; }
  /// How the parts of a drive begin, "HASH@ID@", whichever host they are of.
  [[nodiscard]] std::string part_prefix(const FleetDrive& drive) const;
};

/// Writes job.json and terracut.yaml unless the job is there already. The errors of reading this
/// program's file and of writing.
[[nodiscard]] Expected<RelabelJob> begin_job(const Options& options, const Manifest& manifest);

inline constexpr std::string_view kJobSettings = "terracut.yaml";

/// A job as its folder says.
struct KnownJob {
  struct Drive {
    std::string name;
    std::uint64_t bytes = 0;
  };
  std::filesystem::path state;  ///< Its folder.
  std::filesystem::path manifest;
  std::string version;  ///< Of terracut.
  std::int64_t began_ns = 0;
  std::vector<Drive> drives;
};
/// kNotFound, kUnreadable; kMalformed where job.json is none.
[[nodiscard]] Expected<KnownJob> read_job(const std::filesystem::path& state);
/// Of a folder for drives, by when they began; what is no job is left out. kNotFound where there is
/// none.
[[nodiscard]] Expected<std::vector<KnownJob>> jobs_in(const std::filesystem::path& folder);

/// The words that label a drive by `terracut replay` or `segment` with the settings of that file,
/// but for what is written. kMalformed where an argument of the manifest does not say how the drive
/// is to be read and labelled, and nothing else; the errors of the settings.
[[nodiscard]] Expected<std::vector<std::string>> words_for(const FleetDrive& drive,
                                                           const std::filesystem::path& settings);

/// Everything that a drive's labels depend on, which is what its folder is named by. The errors of
/// content_of().
[[nodiscard]] Expected<nlohmann::ordered_json> recipe_of(const RelabelJob& job,
                                                         const FleetDrive& drive);

/// "NAME-0123456789abcdef", below the job's folder.
[[nodiscard]] std::string output_name_of(const FleetDrive& drive,
                                         const nlohmann::ordered_json& recipe);

}  // namespace terracut::cli
