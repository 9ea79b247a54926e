// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <algorithm>
#include <cstdint>

#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/fleet/drive_search.hpp"

namespace terracut::cli {

ExitCode run_manifest(const Options& options) {
  const auto manifest = find_drives(options.fleet.root);
  if (!manifest) return refuse(manifest.error());
  if (Status written = write_manifest(options.written, *manifest); !written) {
    return refuse(written.error());
  }
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
  return kOk;
}

}  // namespace terracut::cli
