// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "calib/hdl64e_file.hpp"
#include "calib/ruby128_csv.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "firmware_io/drive/drive_writer.hpp"
#include "firmware_io/simulator/drive.hpp"
#include "setup_choice.hpp"

namespace terracut::cli {
namespace {

using firmware_io::Hdl64eTransmitter;
using firmware_io::Ruby128Transmitter;
using firmware_io::RubyTimestamp;

firmware_io::ReturnMode return_mode(const SimulateOptions& options) {
  return options.returns == "dual" ? firmware_io::ReturnMode::kDual
                                   : firmware_io::ReturnMode::kSingle;
}

Expected<Hdl64eTransmitter::Calibration> calibration_of(const SimulateOptions& options,
                                                        Hdl64eTransmitter) {
  if (options.calibration.empty()) return Hdl64eTransmitter::nominal();
  return calib::load_hdl64e_calibration(options.calibration);
}
Expected<Ruby128Transmitter::Calibration> calibration_of(const SimulateOptions& options,
                                                         Ruby128Transmitter) {
  if (options.calibration.empty()) return Ruby128Transmitter::nominal();
  return calib::read_ruby128_csv(options.calibration);
}

Hdl64eTransmitter::Config sensor_config(const SimulateOptions& options, Hdl64eTransmitter) {
  return {.returns = return_mode(options)};
}
Ruby128Transmitter::Config sensor_config(const SimulateOptions& options, Ruby128Transmitter) {
  Ruby128Transmitter::Config config;
  config.returns = return_mode(options);
  if (options.timestamp == "calendar") config.timestamp = RubyTimestamp::kCalendar;
  if (options.timestamp == "ns") config.timestamp = RubyTimestamp::kUtcNanoseconds;
  config.unit.rpm = static_cast<std::uint16_t>(std::lround(60 * options.spin_hz));
  config.unit.serial = {'S', 'I', 'M', 'U', 'L', 'A'};  // nobody takes it for a real unit's
  return config;
}

template <class Transmitter>
Expected<firmware_io::SimulationConfig<Transmitter>> simulation_config(
    const SimulateOptions& options) {
  firmware_io::SimulationConfig<Transmitter> config;
  config.scene = options.scene;
  config.seed = options.seed;
  config.duration_s = options.duration_s;
  config.spin_hz = options.spin_hz;
  config.effects.range_noise_m = options.noise_m;
  config.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 64U));
  config.sensor = sensor_config(options, Transmitter{});
  const auto mount = mount_of(options.mount);
  if (!mount) return tl::unexpected(mount.error());
  config.mount = *mount;
  auto calibration = calibration_of(options, Transmitter{});
  if (!calibration) return tl::unexpected(calibration.error());
  config.calibration = *std::move(calibration);
  return config;
}

template <class Transmitter>
ExitCode simulate(const SimulateOptions& options) {
  const auto config = simulation_config<Transmitter>(options);
  if (!config) return refuse(config.error());
  auto writer = firmware_io::DriveWriter<Transmitter>::create(options.output, config->calibration,
                                                              config->sensor);
  if (!writer) return refuse(writer.error());

  Progress progress("simulating", "seconds", options.duration_s);
  const auto simulated = firmware_io::simulate_drive(
      *config, [&](const firmware_io::SimulatedColumn<Transmitter>& column) -> Status {
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
      firmware_io::calibration_path_of<Transmitter>(options.output).string(),
      firmware_io::truth_folder_of(options.output).string(), written->frames, written->returns,
      written->packets);
  return kOk;
}

}  // namespace

ExitCode run(const SimulateOptions& options) {
  return options.sensor == "ruby128" ? simulate<Ruby128Transmitter>(options)
                                     : simulate<Hdl64eTransmitter>(options);
}

}  // namespace terracut::cli
