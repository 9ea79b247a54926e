// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"
#include "pipeline/run/packet_pipeline.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/settings/setup_choice.hpp"

namespace terracut::cli {
namespace {

calib::SensorCalibration nominal_of(sensor::SensorModel model) {
  if (const auto velodyne = sensor::velodyne_model_of(model)) {
    return velodyne::factory_table(*velodyne);
  }
  if (model == sensor::SensorModel::kRuby128) return ruby128::nominal_ruby128();
  return hdl64e::nominal_hdl64e();
}

}  // namespace

/// Builds the very objects a replay builds, so the figures are those of a replay, not an estimate.
ExitCode run_plan(const Options& options) {
  memory::FixedMemory memory;
  const calib::SensorCalibration calibration =
      nominal_of(options.capture.sensor.value_or(sensor::SensorModel::kHdl64e));
  const auto profile = ring_profile_of(calibration, {});
  if (!profile) return refuse(profile.error());
  const run::PacketPipeline pipeline(calibration, *profile,
                                     decoder_config_of(options, 0, FramesAreFor::kLabels),
                                     method_config_of(options.method), memory);

  nlohmann::ordered_json json;
  fmt::print("{:<24}{:>14}\n", "part", "bytes");
  for (const memory::FixedMemory::Part& part : memory.parts()) {
    fmt::print("{:<24}{:>14}\n", part.name, part.bytes);
    json["parts"][part.name] = part.bytes;
  }
  fmt::print("{:<24}{:>14}  ({:.1f} MiB)\n", "total", memory.total_bytes(),
             static_cast<double>(memory.total_bytes()) / 1048576.0);
  json["total_bytes"] = memory.total_bytes();
  return done_or_refused(write_json(options.output.json, json));
}

}  // namespace terracut::cli
