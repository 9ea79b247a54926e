// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "drive_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "firmware_io/cloud/cloud_file.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;

/// Where to look for what goes with a drive.
struct Beside {
  fs::path folder, root;
  std::string stem;
};

/// The one file of those names that is there; empty: none.
Expected<fs::path> only_one(const fs::path& folder, const std::vector<std::string>& names) {
  std::vector<fs::path> found;
  std::error_code none;
  for (const std::string& name : names) {
    if (fs::is_regular_file(folder / name, none)) found.push_back(folder / name);
  }
  if (found.size() > 1) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{} and {}: either might be meant; name the right one as the drive, "
                            "beside it, or take one away",
                            found[0].string(), found[1].string()));
  }
  return found.empty() ? fs::path() : found.front();
}

/// Of the drive's own name, else of a folder's, the nearest.
Expected<fs::path> find_beside(const Beside& drive, const std::vector<std::string>& suffixes,
                               const std::vector<std::string>& names) {
  std::vector<std::string> own;
  for (const std::string& suffix : suffixes) own.push_back(drive.stem + suffix);
  auto found = only_one(drive.folder, own);
  for (fs::path at = drive.folder; found && found->empty(); at = at.parent_path()) {
    found = only_one(at, names);
    if (at == drive.root || at == at.parent_path()) break;
  }
  return found;
}

Status add_companions(const Beside& beside, FleetDrive& drive) {
  const auto take = [](Expected<fs::path> found, fs::path& place) -> Status {
    if (!found) return tl::unexpected(found.error());
    place = *std::move(found);
    return {};
  };
  if (Status setup = take(find_beside(beside, {".setup.yaml"}, {"setup.yaml"}), drive.setup);
      !setup || drive.capture.empty()) {
    return setup;
  }
  Status found =
      take(find_beside(beside, {".calibration.xml", ".calibration.yaml", ".calibration.csv"},
                       {"db.xml", "db.yaml", "angle.csv", "calibration.xml", "calibration.yaml",
                        "calibration.csv"}),
           drive.calibration);
  if (found) found = take(only_one(beside.folder, {beside.stem + ".can.log"}), drive.can);
  if (!found || drive.can.empty()) return found;
  found = take(find_beside(beside, {".can.dbc"}, {"vehicle.dbc"}), drive.dbc);
  if (!found || !drive.dbc.empty()) return found;
  return fail(ErrorCode::kMalformed,
              fmt::format("{}: there is neither {}.can.dbc nor a vehicle.dbc that says what its "
                          "frames mean; add one, or take the recording away",
                          drive.can.string(), beside.stem));
}

/// Files of a tree: captures, and how many bytes of clouds a folder has.
struct Found {
  std::set<fs::path> captures;
  std::map<fs::path, std::uint64_t> clouds;
};

Expected<Found> look_below(const fs::path& root) {
  Found found;
  std::error_code error;
  fs::recursive_directory_iterator entry(root, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const fs::path& path = entry->path();
    std::error_code vanished;
    if (path.filename().native().starts_with('.')) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file(vanished)) {
      const std::string ending = path.extension().string();
      if (ending == ".pcap" || ending == ".pcapng") found.captures.insert(path);
      if (cloud::is_cloud_file(path)) {
        found.clouds[path.parent_path()] += entry->file_size(vanished);
      }
    }
  }
  if (!error) return found;
  return fail(
      error == std::errc::no_such_file_or_directory ? ErrorCode::kNotFound : ErrorCode::kUnreadable,
      fmt::format("{}: {}", root.string(), error.message()));
}

/// Without its ending, where no other drive may be called that.
fs::path name_of_capture(const fs::path& capture) {
  const fs::path stem = fs::path(capture).replace_extension();
  const fs::path twin =
      fs::path(capture).replace_extension(capture.extension() == ".pcap" ? ".pcapng" : ".pcap");
  std::error_code none;
  return fs::exists(stem, none) || fs::exists(twin, none) ? capture : stem;
}

}  // namespace

Expected<Manifest> find_drives(const fs::path& root) {
  Manifest manifest;
  std::error_code error;
  manifest.root = fs::canonical(root, error);
  if (error) return fail(ErrorCode::kNotFound, root.string() + ": " + error.message());
  const auto found = look_below(manifest.root);
  if (!found) return tl::unexpected(found.error());

  const auto add = [&](FleetDrive drive, const fs::path& place, const fs::path& named) -> Status {
    drive.name = place == manifest.root ? place.filename().string()
                                        : named.lexically_relative(manifest.root).string();
    const fs::path folder = place == manifest.root ? place : place.parent_path();
    const fs::path stem = drive.capture.empty() ? place.filename() : place.stem();
    const Status added = add_companions({folder, manifest.root, stem.string()}, drive);
    if (added) manifest.drives.push_back(std::move(drive));
    return added;
  };
  for (const fs::path& capture : found->captures) {
    FleetDrive drive;
    drive.capture = capture;
    drive.bytes = fs::file_size(capture, error);
    if (Status added = add(std::move(drive), capture, name_of_capture(capture)); !added) {
      return tl::unexpected(added.error());
    }
  }
  for (const auto& [folder, bytes] : found->clouds) {
    const bool is_sequence = folder.filename() == "velodyne" && folder != manifest.root;
    const fs::path place = is_sequence ? folder.parent_path() : folder;
    FleetDrive drive;
    drive.scans = place;
    drive.bytes = bytes;
    if (Status added = add(std::move(drive), place, place); !added) {
      return tl::unexpected(added.error());
    }
  }
  if (!manifest.drives.empty()) return manifest;
  return fail(ErrorCode::kNotFound,
              fmt::format("{}: no drive in it: expected captures (.pcap, .pcapng) or folders of "
                          "clouds (.bin, .pcd, .ply)",
                          root.string()));
}

}  // namespace terracut::cli
