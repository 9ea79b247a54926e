// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "firmware_io/vehicle/ego_motion.hpp"
#include "pipeline/mcap/mcap_sink.hpp"
#include "pipeline/run/packet_pipeline.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/settings/motion_choice.hpp"
#include "tools/cli/settings/setup_choice.hpp"

namespace terracut::cli {
namespace {

/// Returns the resident memory of this process in bytes; 0 if the system does not tell.
std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// Returns the memory that a process of `relabel` needs to write a drive's labels, if all frames
/// are as large as possible.
std::size_t output_bytes(FleetFormat format, std::size_t returns) {
  switch (format) {
    case FleetFormat::kLabels:
      return returns * sizeof(std::uint32_t);
    case FleetFormat::kMcap:
      return mcap::McapSink::memory_bytes(returns);
  }
  return 0;
}

/// Builds in `memory` the objects that label a capture, and returns the most returns that a frame
/// can have.
std::size_t take_memory(const Options& options, const calib::SensorCalibration& calibration,
                        const mount::RingProfile& profile, bool has_motion,
                        memory::FixedMemory& memory) {
  std::optional<vehicle::EgoMotion> motion;
  if (has_motion) motion.emplace(ego_motion_config_of(options.motion), memory);
  const auto makes = options.fleet.format == FleetFormat::kLabels
                         ? run::PacketPipeline::Makes::kLabels
                         : run::PacketPipeline::Makes::kPoints;
  const run::PacketPipeline pipeline(calibration, profile,
                                     decoder_config_of(options, 0, motion ? &*motion : nullptr),
                                     turn_method_of(options.method), memory, makes);
  return pipeline.decoder().return_capacity();
}

double to_mib(std::size_t bytes) {
  return static_cast<double>(bytes) / 1048576.0;
}

}  // namespace

/// Builds the same objects as a replay, so the figures are exact, not an estimate.
ExitCode run_plan(const Options& options) {
  const std::size_t program_bytes = resident_bytes();
  const calib::SensorCalibration calibration =
      calib::nominal(options.capture.sensor.value_or(sensor::SensorModel::kHdl64e));
  const auto profile = ring_profile_of(calibration, {});
  if (!profile) return refuse(profile.error());
  memory::FixedMemory memory, memory_with_motion;
  const std::size_t returns = take_memory(options, calibration, *profile, false, memory);
  (void)take_memory(options, calibration, *profile, true, memory_with_motion);

  nlohmann::ordered_json json;
  print_out("{:<24}{:>14}\n", "part", "bytes");
  for (const memory::FixedMemory::Part& part : memory.parts()) {
    print_out("{:<24}{:>14}\n", part.name, part.bytes);
    json["parts"][part.name] = part.bytes;
  }
  print_out("{:<24}{:>14}  ({:.1f} MiB)\n", "total", memory.total_bytes(),
            to_mib(memory.total_bytes()));
  json["total_bytes"] = memory.total_bytes();

  // Enough for the report's sums, a capture's reading buffer, and code that only a run loads.
  constexpr std::size_t kRest_bytes = std::size_t{4} << 20;
  const std::size_t beside_bytes =
      program_bytes + kRest_bytes + output_bytes(options.fleet.format, returns);
  const auto print = [&](const char* name, const char* key, std::size_t planned_bytes) {
    const std::size_t bytes = beside_bytes + planned_bytes;
    print_out("{:<24}{:>14}  ({:.1f} MiB)\n", name, bytes, to_mib(bytes));
    json[key] = bytes;
  };
  print("a process of relabel", "process_bytes", memory.total_bytes());
  print("with a CAN recording", "process_with_motion_bytes", memory_with_motion.total_bytes());
  return done_or_refused(write_json(options.output.json, json));
}

}  // namespace terracut::cli
