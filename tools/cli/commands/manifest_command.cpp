// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/fleet/drive_search.hpp"
#include "tools/cli/terminal_text.hpp"

namespace terracut::cli {
namespace {

/// Prints one line for each kind of path left out.
void warn_of(const std::vector<LeftOut>& left_out) {
  std::map<std::string, std::pair<std::size_t, std::string>> kinds;  // count, first path
  for (const auto& [path, why] : left_out) {
    auto& [count, first] = kinds[why];
    if (count++ == 0) first = path.string();
  }
  for (const auto& [why, of_kind] : kinds) {
    const auto& [count, first] = of_kind;
    warn(line_for_terminal(
        count == 1 ? fmt::format("left out: {}: {}", first, why)
                   : fmt::format("left out: {} and {} more: {}", first, count - 1, why)));
  }
}

}  // namespace

ExitCode run_manifest(const Options& options) {
  const auto manifest = find_drives(options.fleet.root);
  if (!manifest) return refuse(manifest.error());
  if (Status written = write_manifest(options.written, *manifest); !written) {
    return refuse(written.error());
  }
  warn_of(manifest->left_out);
  std::uint64_t bytes = 0;
  for (const FleetDrive& drive : manifest->drives) bytes += drive.bytes;
  const auto with = [&](auto member) {
    return std::ranges::count_if(manifest->drives,
                                 [&](const FleetDrive& drive) { return !(drive.*member).empty(); });
  };
  print_out("wrote     {}\n", options.written.string());
  print_out("drives    {}, {:.2f} GB: {} captures, {} folders of clouds\n", manifest->drives.size(),
            static_cast<double>(bytes) * 1e-9, with(&FleetDrive::capture),
            with(&FleetDrive::scans));
  print_out("with      a calibration {}, a setup {}, a CAN recording {}\n",
            with(&FleetDrive::calibration), with(&FleetDrive::setup), with(&FleetDrive::can));
  if (!manifest->left_out.empty()) {
    print_out("left out  {} files or folders, named in it\n", manifest->left_out.size());
  }
  return kOk;
}

}  // namespace terracut::cli
