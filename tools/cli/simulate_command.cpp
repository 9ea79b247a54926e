// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include "calib/angle.hpp"
#include "calib/hdl64e_file.hpp"
#include "calib/ruby128_csv.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "firmware_io/drive/drive_writer.hpp"
#include "firmware_io/motion/vehicle_log.hpp"
#include "firmware_io/simulator/drive.hpp"
#include "setup_choice.hpp"
#include "stop_signal.hpp"
#include "temporary_folder.hpp"

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
  config.speed_mps = options.speed_mps;
  config.yaw_rate_radps = calib::deg_to_rad(options.yaw_rate_dps);
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
ExitCode simulate(const SimulateOptions& options, const std::filesystem::path& output) {
  const auto config = simulation_config<Transmitter>(options);
  if (!config) return refuse(config.error());
  auto writer =
      firmware_io::DriveWriter<Transmitter>::create(output, config->calibration, config->sensor);
  if (!writer) return refuse(writer.error());

  Progress progress("simulating", "seconds", options.duration_s);
  const auto simulated = firmware_io::simulate_drive(
      *config, [&](const firmware_io::SimulatedColumn<Transmitter>& column) -> Status {
        if (Status status = go_on(); !status) return status;
        progress.update(column.time_s);
        return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                  column.wire.by_laser);
      });
  if (!simulated) return refuse_work(simulated.error());
  const auto written = writer->finish();
  if (!written) return refuse(written.error());
  if (options.can_log) {
    const auto samples = firmware_io::simulated_motion(*config);
    if (!samples) return refuse(samples.error());
    const Status logged = firmware_io::write_vehicle_log(output, *samples);
    if (!logged) return refuse(logged.error());
  }

  fmt::print("scene     {}, seed {}\n", options.scene, options.seed);
  if (!options.output.empty()) {
    fmt::print("wrote     {}\n          {}\n          {}/\n", output.string(),
               firmware_io::calibration_path_of<Transmitter>(output).string(),
               firmware_io::truth_folder_of(output).string());
    if (options.can_log) {
      fmt::print("          {}\n          {}\n", firmware_io::can_log_path_of(output).string(),
                 firmware_io::can_dbc_path_of(output).string());
    }
  }
  fmt::print("frames    {}\nreturns   {}\npackets   {}\n", written->frames, written->returns,
             written->packets);
  std::fflush(stdout);
  return kOk;
}

ExitCode simulate_to(const SimulateOptions& options, const std::filesystem::path& output) {
  return options.sensor == "ruby128" ? simulate<Ruby128Transmitter>(options, output)
                                     : simulate<Hdl64eTransmitter>(options, output);
}

}  // namespace

ExitCode run(const SimulateOptions& options) {
  catch_stop_signals();
  if (options.udp.to.empty()) {
    if (options.output.empty()) {
      return refuse(kUsage, "nothing to do: -o FILE writes the drive, --udp ADDRESS:PORT sends it");
    }
    return simulate_to(options, options.output);
  }
  // Rays take longer to trace than a turn lasts: the drive is computed first, then sent on time.
  std::optional<TemporaryFolder> scratch;
  SendOptions sending = options.udp;
  sending.file = options.output;
  if (sending.file.empty()) {
    scratch.emplace();
    if (scratch->path().empty()) return refuse(kOutputFailed, "no temporary folder can be made");
    sending.file = scratch->path() / "drive.pcap";
  }
  const ExitCode simulated = simulate_to(options, sending.file);
  return simulated == kOk ? run(sending) : simulated;
}

}  // namespace terracut::cli
