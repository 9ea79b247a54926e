// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "drive_inputs.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <system_error>

#include "content_hash.hpp"
#include "firmware_io/cloud/cloud_file.hpp"
#include "firmware_io/scan/scan_folder.hpp"
#include "tools/cli/settings/companion_files.hpp"

namespace terracut::cli {
namespace {

Expected<std::string> stamp_of_file(const std::filesystem::path& path) {
  struct stat file{};
  if (::stat(path.c_str(), &file) != 0) {
    return fail(errno == ENOENT ? ErrorCode::kNotFound : ErrorCode::kUnreadable,
                fmt::format("{}: {}", path.string(), std::generic_category().message(errno)));
  }
  return fmt::format("{} bytes, written {}.{:09}, changed {}.{:09}", file.st_size,
                     file.st_mtim.tv_sec, file.st_mtim.tv_nsec, file.st_ctim.tv_sec,
                     file.st_ctim.tv_nsec);
}

/// Returns a hash of the names of the clouds in a folder and of what `of_file` returns for each.
template <class OfFile>
Expected<std::string> of_clouds(const std::filesystem::path& folder, OfFile&& of_file) {
  const auto listed = scan::list_scan_folder(folder, cloud::kCloudFiles);
  if (!listed) return tl::unexpected(listed.error());
  ContentHash hash;
  for (const scan::ScanFile& file : listed->scans) {
    const Expected<std::string> its = of_file(file.points);
    if (!its) return its;
    hash.add(fmt::format("{}  {}\n", *its, file.points.filename().string()));
  }
  return hash.digits();
}

}  // namespace

std::vector<DriveInput> inputs_of(const FleetDrive& drive) {
  std::vector<DriveInput> inputs{
      {"capture", drive.capture}, {"scans", drive.scans}, {"calibration", drive.calibration},
      {"setup", drive.setup},     {"can", drive.can},     {"dbc", drive.dbc}};
  std::erase_if(inputs, [](const DriveInput& input) { return input.path.empty(); });
  if (drive.capture.empty() || !drive.calibration.empty()) return inputs;
  // If the packets hold no calibration, a run uses the one beside the capture, so it is an input,
  // too.
  const auto beside = calibration_beside(drive.capture);
  if (beside && !beside->empty()) inputs.push_back({"calibration", *beside});
  return inputs;
}

Expected<nlohmann::ordered_json> stamps_of(const FleetDrive& drive) {
  auto stamps = nlohmann::ordered_json::object();
  for (const DriveInput& input : inputs_of(drive)) {
    auto stamp =
        input.role == "scans" ? of_clouds(input.path, stamp_of_file) : stamp_of_file(input.path);
    if (!stamp) return tl::unexpected(stamp.error());
    stamps[std::string(input.role)] = *std::move(stamp);
  }
  return stamps;
}

Expected<std::string> content_of(const DriveInput& input) {
  return input.role == "scans" ? of_clouds(input.path, sha256_of_file) : sha256_of_file(input.path);
}

}  // namespace terracut::cli
