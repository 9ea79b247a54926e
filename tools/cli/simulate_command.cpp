// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "calib/hdl64e_file.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "firmware_io/hdl64e/drive_writer.hpp"
#include "firmware_io/simulator/drive.hpp"
#include "setup_choice.hpp"

namespace terracut::cli {
namespace {

Expected<firmware_io::SimulationConfig> simulation_config(const SimulateOptions& options) {
  firmware_io::SimulationConfig config;
  config.scene = options.scene;
  config.seed = options.seed;
  config.duration_s = options.duration_s;
  config.effects.range_noise_m = options.noise_m;
  config.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 64U));
  const auto mount = mount_of(options.mount);
  if (!mount) return tl::unexpected(mount.error());
  config.mount = *mount;
  if (!options.calibration.empty()) {
    auto calibration = calib::load_hdl64e_calibration(options.calibration);
    if (!calibration) return tl::unexpected(calibration.error());
    config.calibration = *std::move(calibration);
  }
  return config;
}

}  // namespace

ExitCode run(const SimulateOptions& options) {
  const auto config = simulation_config(options);
  if (!config) return refuse(config.error());
  auto writer = firmware_io::DriveWriter::create(options.output, config->calibration);
  if (!writer) return refuse(writer.error());

  Progress progress("simulating", "seconds", options.duration_s);
  const auto simulated = firmware_io::simulate_drive(
      *config, [&](const firmware_io::SimulatedColumn& column) -> Status {
        progress.update(column.time_s);
        return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                  column.wire.by_laser);
      });
  if (!simulated) return refuse(simulated.error());
  const auto written = writer->finish();
  if (!written) return refuse(written.error());

  fmt::print(
      "scene     {}, seed {}\nwrote     {}\n          {}\n          {}/\n"
      "frames    {}\nreturns   {}\npackets   {}\n",
      options.scene, options.seed, options.output.string(),
      firmware_io::calibration_path_of(options.output).string(),
      firmware_io::truth_folder_of(options.output).string(), written->frames, written->returns,
      written->packets);
  return kOk;
}

}  // namespace terracut::cli
