// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "companion_files.hpp"

#include <fmt/format.h>

#include <string_view>
#include <system_error>
#include <vector>

#include "firmware_io/bag/bag.hpp"
#include "firmware_io/capture/file_kind.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;

/// Returns the only existing file of those names; empty if there is none.
Expected<fs::path> only_one(const fs::path& folder, const std::vector<std::string>& names) {
  std::vector<fs::path> found;
  std::error_code none;
  for (const std::string& name : names) {
    if (fs::is_regular_file(folder / name, none)) found.push_back(folder / name);
  }
  if (found.size() > 1) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{} and {}: either might be meant; name the right one as the "
                            "recording, beside it, or take one away",
                            found[0].string(), found[1].string()));
  }
  return found.empty() ? fs::path() : found.front();
}

/// Finds a file by the drive's own name, or else by a usual name in the nearest folder.
Expected<fs::path> find_beside(const Beside& recording, const std::vector<std::string>& suffixes,
                               const std::vector<std::string>& names) {
  std::vector<std::string> own;
  for (const std::string& suffix : suffixes) own.push_back(recording.stem + suffix);
  auto found = only_one(recording.folder, own);
  for (fs::path at = recording.folder; found && found->empty(); at = at.parent_path()) {
    found = only_one(at, names);
    if (at == recording.root || at == at.parent_path()) break;
  }
  return found;
}

}  // namespace

std::string stem_of(const fs::path& capture) {
  const std::string name = capture.filename().string();
  const std::string_view stem = capture::capture_stem(name);
  if (stem.empty() && bag::is_bag_name(capture)) return name.substr(0, name.find_last_of('.'));
  return stem.empty() ? name : std::string(stem);
}

Expected<fs::path> setup_beside(const Beside& recording) {
  return find_beside(recording, {".setup.yaml"}, {"setup.yaml"});
}

Expected<fs::path> calibration_beside(const Beside& recording) {
  return find_beside(
      recording, {".calibration.xml", ".calibration.yaml", ".calibration.csv", ".calibration.json"},
      {"db.xml", "db.yaml", "angle.csv", "calibration.xml", "calibration.yaml", "calibration.csv",
       "calibration.json", "metadata.json"});
}

Expected<fs::path> calibration_beside(const fs::path& capture) {
  const fs::path folder = capture.parent_path();
  return calibration_beside(Beside{folder, folder, stem_of(capture)});
}

Expected<fs::path> metadata_beside(const fs::path& capture) {
  const std::string stem = stem_of(capture);
  return only_one(capture.parent_path(), {stem + ".calibration.json", stem + ".json"});
}

Expected<fs::path> can_beside(const Beside& recording) {
  return only_one(recording.folder, {recording.stem + ".can.log"});
}

Expected<fs::path> dbc_beside(const Beside& recording) {
  return find_beside(recording, {".can.dbc"}, {"vehicle.dbc"});
}

}  // namespace terracut::cli
