// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "drive_inputs.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <system_error>

#include "content_hash.hpp"
#include "firmware_io/bag/bag.hpp"
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

/// Returns the files of an input, if it is a folder: clouds, or the files of a bag.
Expected<std::vector<std::filesystem::path>> files_in(const DriveInput& input) {
  if (bag::is_bag(input.path)) return bag::files_of(input.path);
  const auto listed = scan::list_scan_folder(input.path, cloud::kCloudFiles);
  if (!listed) return tl::unexpected(listed.error());
  std::vector<std::filesystem::path> files;
  for (const scan::ScanFile& file : listed->scans) files.push_back(file.points);
  return files;
}

/// Returns what `of_file` returns for an input; for a folder, a hash of the names of its files and
/// of what it returns for each.
template <class OfFile>
Expected<std::string> of_input(const DriveInput& input, OfFile&& of_file) {
  std::error_code none;
  if (!std::filesystem::is_directory(input.path, none)) return of_file(input.path);
  const auto files = files_in(input);
  if (!files) return tl::unexpected(files.error());
  ContentHash hash;
  for (const std::filesystem::path& file : *files) {
    const Expected<std::string> its = of_file(file);
    if (!its) return its;
    hash.add(fmt::format("{}  {}\n", *its, file.filename().string()));
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
    auto stamp = of_input(input, stamp_of_file);
    if (!stamp) return tl::unexpected(stamp.error());
    stamps[std::string(input.role)] = *std::move(stamp);
  }
  return stamps;
}

Expected<std::string> content_of(const DriveInput& input) {
  return of_input(input, sha256_of_file);
}

}  // namespace terracut::cli
