// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "calib/nominal_hdl64e.hpp"
#include "calib/nominal_ruby128.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "packet_chain.hpp"
#include "rt/whole_file.hpp"
#include "setup_choice.hpp"

namespace terracut::cli {

/// Builds the very objects a replay builds, so the figures are those of a replay, not an estimate.
ExitCode run(const PlanOptions& options) {
  rt::FixedMemory memory;
  const calib::SensorCalibration calibration =
      options.sensor == "ruby128" ? calib::SensorCalibration(calib::nominal_ruby128())
                                  : calib::SensorCalibration(calib::nominal_hdl64e());
  const auto profile = ring_profile_of(calibration, {});
  if (!profile) return refuse(profile.error());
  const PacketChainOf<pipeline::GroundMethod> chain(calibration, *profile, 0, {}, options.method,
                                                    memory);

  nlohmann::ordered_json json;
  fmt::print("{:<24}{:>14}\n", "part", "bytes");
  for (const rt::FixedMemory::Part& part : memory.parts()) {
    fmt::print("{:<24}{:>14}\n", part.name, part.bytes);
    json["parts"][part.name] = part.bytes;
  }
  fmt::print("{:<24}{:>14}  ({:.1f} MiB)\n", "total", memory.total_bytes(),
             static_cast<double>(memory.total_bytes()) / 1048576.0);
  json["total_bytes"] = memory.total_bytes();
  if (options.json.empty()) return kOk;
  const Status written = rt::write_whole_file(options.json, json.dump(1) + "\n");
  return written ? kOk : refuse(written.error());
}

}  // namespace terracut::cli
