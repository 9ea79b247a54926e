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

#include "firmware_io/bag/bag.hpp"
#include "firmware_io/bag/topic_choice.hpp"
#include "tools/cli/input/recording_tree.hpp"
#include "tools/cli/settings/companion_files.hpp"
#include "tools/cli/terminal_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;

Status add_companions(const Beside& beside, FleetDrive& drive) {
  const auto take = [](Expected<fs::path> found, fs::path& place) -> Status {
    if (!found) return tl::unexpected(found.error());
    place = *std::move(found);
    return {};
  };
  if (Status setup = take(setup_beside(beside), drive.setup); !setup || drive.capture.empty()) {
    return setup;
  }
  Status found = take(calibration_beside(beside), drive.calibration);
  if (found) found = take(can_beside(beside), drive.can);
  if (!found || drive.can.empty()) return found;
  found = take(dbc_beside(beside), drive.dbc);
  if (!found || !drive.dbc.empty()) return found;
  return fail(ErrorCode::kMalformed,
              fmt::format("{}: there is neither {}.can.dbc nor a vehicle.dbc that says what its "
                          "frames mean; add one, or take the recording away",
                          drive.can.string(), beside.stem));
}

/// Counts for each path without ending how many captures have it.
std::map<fs::path, int> count_stems(const std::set<fs::path>& captures) {
  std::map<fs::path, int> counts;
  for (const fs::path& capture : captures) ++counts[capture.parent_path() / stem_of(capture)];
  return counts;
}

/// True if the only topic of a bag that could be labelled holds clouds, false if it holds packets.
Expected<bool> holds_clouds(const fs::path& recording) {
  const auto bag = bag::Bag::open(recording);
  if (!bag) return tl::unexpected(bag.error());
  const auto topic = bag::choose_topic(*bag, {}, bag::Content::kEither);
  if (!topic) return tl::unexpected(topic.error());
  return bag::holds_clouds(bag->topics()[*topic].type);
}

/// Lists some paths for a message.
std::string some_of(const std::vector<LeftOut>& left_out) {
  constexpr std::size_t kShown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, left_out.size()); ++i) {
    text += fmt::format("; {}: {}", left_out[i].path.string(), left_out[i].why);
  }
  if (left_out.size() > kShown) text += fmt::format("; {} more", left_out.size() - kShown);
  return text;
}

/// Returns a root's name without leading dots, which relabel accepts for outputs.
std::string name_of_root(const fs::path& root) {
  const std::string name = root.filename().string();
  const std::size_t begin = name.find_first_not_of('.');
  return begin == std::string::npos ? "drive" : name.substr(begin);
}

}  // namespace

Expected<Manifest> find_drives(const fs::path& root) {
  Manifest manifest;
  std::error_code error;
  manifest.root = fs::canonical(root, error);
  if (error) return fail(ErrorCode::kNotFound, root.string() + ": " + error.message());
  if (!is_utf8(manifest.root.native())) {
    return fail(ErrorCode::kMalformed,
                manifest.root.string() +
                    ": a name that is no UTF-8, which a manifest cannot hold; "
                    "rename it (convmv)");
  }
  RecordingTree found = find_recordings(manifest.root);
  manifest.left_out = std::move(found.left_out);

  const auto add = [&](FleetDrive drive, const fs::path& place, const fs::path& named,
                       const std::string& stem) -> Status {
    drive.name = place == manifest.root ? name_of_root(place)
                                        : named.lexically_relative(manifest.root).string();
    const fs::path folder = place == manifest.root ? place : place.parent_path();
    const Status added = add_companions({folder, manifest.root, stem}, drive);
    if (added) manifest.drives.push_back(std::move(drive));
    return added;
  };
  const std::map<fs::path, int> stems = count_stems(found.captures);
  for (const fs::path& capture : found.captures) {
    FleetDrive drive;
    drive.capture = capture;
    drive.bytes = fs::file_size(capture, error);
    if (error) drive.bytes = 0;
    const std::string stem = stem_of(capture);
    const fs::path short_name = capture.parent_path() / stem;
    const bool is_free = stems.at(short_name) == 1 && !fs::exists(short_name, error);
    if (Status added = add(std::move(drive), capture, is_free ? short_name : capture, stem);
        !added) {
      return tl::unexpected(added.error());
    }
  }
  for (const fs::path& recording : found.bags) {
    const auto has_clouds = holds_clouds(recording);
    if (!has_clouds) {
      std::string why = has_clouds.error().message;
      if (const std::string place = recording.string() + ": "; why.starts_with(place)) {
        why.erase(0, place.size());
      }
      manifest.left_out.push_back({recording, std::move(why)});
      continue;
    }
    FleetDrive drive;
    (*has_clouds ? drive.scans : drive.capture) = recording;
    for (const fs::path& file : bag::files_of(recording)) {
      const std::uintmax_t bytes = fs::file_size(file, error);
      drive.bytes += error ? 0 : bytes;
    }
    if (Status added = add(std::move(drive), recording, recording, stem_of(recording)); !added) {
      return tl::unexpected(added.error());
    }
  }
  for (const auto& [folder, bytes] : found.clouds) {
    const bool is_sequence = folder.filename() == "velodyne" && folder != manifest.root;
    const fs::path place = is_sequence ? folder.parent_path() : folder;
    if (!is_sequence && found.clouds.contains(folder / "velodyne")) {
      manifest.left_out.push_back(
          {folder, "clouds beside those in velodyne/; move them into a folder of their own"});
      continue;
    }
    FleetDrive drive;
    drive.scans = place;
    drive.bytes = bytes;
    if (Status added = add(std::move(drive), place, place, place.filename().string()); !added) {
      return tl::unexpected(added.error());
    }
  }
  if (!manifest.drives.empty()) return manifest;
  return fail(ErrorCode::kNotFound,
              fmt::format("{}: no drive in it: expected captures (.pcap, .pcapng), bags (.mcap, "
                          ".db3) or folders of clouds (.bin, .pcd, .ply){}",
                          root.string(), some_of(manifest.left_out)));
}

}  // namespace terracut::cli
