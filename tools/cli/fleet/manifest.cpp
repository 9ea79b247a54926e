// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "tools/cli/json_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

/// Calls `use` with each path of a drive and the path's name in the manifest.
template <class Drive>
auto paths_in(Drive& drive) {
  return std::array{std::pair{"capture", &drive.capture},
                    std::pair{"scans", &drive.scans},
                    std::pair{"calibration", &drive.calibration},
                    std::pair{"setup", &drive.setup},
                    std::pair{"can", &drive.can},
                    std::pair{"dbc", &drive.dbc}};
}

bool has_nul(const std::string& text) {
  return text.find('\0') != std::string::npos;
}

/// True if outputs may have this name: a relative path without parts that begin with a dot.
bool is_name(const std::string& name) {
  const fs::path path(name);
  return !name.empty() && !has_nul(name) && path.is_relative() && path.has_filename() &&
         std::ranges::none_of(path,
                              [](const fs::path& part) { return part.native().starts_with('.'); });
}

/// Reads a drive. Throws nlohmann::json::exception if a member has the wrong type.
FleetDrive drive_in(const Json& json, const fs::path& root) {
  FleetDrive drive;
  drive.name = json.value("name", "");
  drive.bytes = json.value("bytes", std::uint64_t{0});
  drive.arguments = json.value("arguments", std::vector<std::string>{});
  for (const auto& [key, path] : paths_in(drive)) {
    if (const auto text = json.value(key, std::string()); !text.empty()) *path = root / text;
  }
  return drive;
}

std::string fault_of(const FleetDrive& drive, std::set<std::string>& names) {
  if (!is_name(drive.name)) {
    return fmt::format(
        "'{}' is no name of a drive: expected a relative path whose parts do not begin with '.'",
        drive.name);
  }
  const auto paths = paths_in(drive);
  if (std::ranges::any_of(drive.arguments, has_nul) ||
      std::ranges::any_of(paths, [](const auto& of) { return has_nul(of.second->native()); })) {
    return fmt::format("{}: a path or an argument of it has a zero byte", drive.name);
  }
  if (!names.insert(drive.name).second) return fmt::format("two drives are called {}", drive.name);
  if (drive.capture.empty() == drive.scans.empty()) {
    return fmt::format("{}: expected one of capture and scans", drive.name);
  }
  if (drive.can.empty() != drive.dbc.empty()) {
    return fmt::format("{}: expected both of can and dbc, or none", drive.name);
  }
  return {};
}

}  // namespace

Expected<Manifest> read_manifest(const fs::path& path) {
  const auto malformed = [&](std::string_view what) {
    return fail(
        ErrorCode::kMalformed,
        fmt::format("{}: no manifest: {}; `terracut manifest` makes one", path.string(), what));
  };
  constexpr std::size_t kMostBytes = std::size_t{1} << 28;  // enough for a million drives
  const auto read = read_json(path, kMostBytes);
  if (!read && read.error().code != ErrorCode::kMalformed) return tl::unexpected(read.error());
  if (!read) return malformed(read.error().message);
  const Json& json = *read;
  Manifest manifest;
  try {
    if (json.value("manifest", Json()) != kVersion) return malformed("manifest is to be 1");
    manifest.root = (fs::absolute(path).parent_path() / json.value("root", "")).lexically_normal();
    std::set<std::string> names;
    for (const Json& drive : json.at("drives")) {
      if (!are_counts(drive, {"bytes"})) return malformed("bytes of a drive are no whole number");
      manifest.drives.push_back(drive_in(drive, manifest.root));
      const std::string fault = fault_of(manifest.drives.back(), names);
      if (!fault.empty()) return malformed(fault);
    }
  } catch (const nlohmann::json::exception& error) {
    return malformed(error.what());
  }
  if (manifest.drives.empty()) return malformed("it lists no drive");
  return manifest;
}

Status write_manifest(const fs::path& path, const Manifest& manifest) {
  const auto in_file = [&](const fs::path& place) {
    const fs::path below = place.lexically_relative(manifest.root);
    return below.empty() || *below.begin() == ".." ? place.string() : below.string();
  };
  Json json{{"manifest", kVersion}, {"root", manifest.root.string()}, {"drives", Json::array()}};
  for (const FleetDrive& drive : manifest.drives) {
    Json& entry = json["drives"].emplace_back(Json{{"name", drive.name}});
    for (const auto& [key, of_drive] : paths_in(drive)) {
      if (!of_drive->empty()) entry[key] = in_file(*of_drive);
    }
    if (!drive.arguments.empty()) entry["arguments"] = drive.arguments;
    entry["bytes"] = drive.bytes;
  }
  for (const LeftOut& left_out : manifest.left_out) {
    json["left_out"].push_back(Json{{"path", in_file(left_out.path)}, {"why", left_out.why}});
  }
  return write_json(path, json);
}

Expected<Shard> parse_shard(std::string_view text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  if (number.ec == std::errc() && number.ptr != end && *number.ptr == '/') {
    const auto of = std::from_chars(number.ptr + 1, end, shard.of);
    if (of.ec == std::errc() && of.ptr == end && shard.number >= 1 && shard.number <= shard.of) {
      return shard;
    }
  }
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("--shard: expected I/N with 1 <= I <= N, as 3/12, found '{}'", text));
}

std::vector<FleetDrive> drives_of(const Manifest& manifest, const Shard& shard) {
  std::vector<FleetDrive> drives = manifest.drives;
  std::ranges::sort(drives, [](const FleetDrive& a, const FleetDrive& b) {
    return std::tie(b.bytes, a.name) < std::tie(a.bytes, b.name);
  });
  using Load = std::pair<std::uint64_t, std::size_t>;  // bytes, number of the shard
  std::set<Load> loads;
  // A drive is never divided, so with more shards than drives some shards are empty.
  const std::size_t filled = std::min(shard.of, drives.size());
  for (std::size_t i = 1; i <= filled; ++i) loads.emplace(0, i);
  std::vector<FleetDrive> its_own;
  for (FleetDrive& drive : drives) {
    Load emptiest = *loads.begin();
    loads.erase(loads.begin());
    emptiest.first += std::max<std::uint64_t>(drive.bytes, 1);
    loads.insert(emptiest);
    if (emptiest.second == shard.number) its_own.push_back(std::move(drive));
  }
  return its_own;
}

}  // namespace terracut::cli
