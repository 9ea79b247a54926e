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

#include "calib/beams/angle.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/input/command_files.hpp"
#include "tools/cli/settings/made_calibration.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"
#include "tools/cli/temporary_folder.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/drive/vehicle_log.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace terracut::cli {
namespace {

using encode::Hdl64eEncoderTraits;
using encode::Ruby128EncoderTraits;

Hdl64eEncoderTraits::Config sensor_config(const Options& options, Hdl64eEncoderTraits) {
  return {.returns = options.simulate.returns};
}
Ruby128EncoderTraits::Config sensor_config(const Options& options, Ruby128EncoderTraits) {
  Ruby128EncoderTraits::Config config;
  config.returns = options.simulate.returns;
  config.timestamp = options.simulate.timestamp;
  config.unit.rpm = static_cast<std::uint16_t>(std::lround(60 * options.simulate.spin_hz));
  config.unit.serial = {'S', 'I', 'M', 'U', 'L', 'A'};  // nobody takes it for a real unit's
  return config;
}
template <class Model>
typename velodyne::VelodyneEncoderTraits<Model>::Config sensor_config(
    const Options& options, velodyne::VelodyneEncoderTraits<Model>) {
  return {.returns = options.simulate.returns};
}

template <class EncoderTraits>
Expected<simulator::SimulationConfig<EncoderTraits>> simulation_config(const Options& options) {
  simulator::SimulationConfig<EncoderTraits> config;
  config.scene = options.simulate.scene;
  config.seed = options.simulate.seed;
  config.duration_s = options.simulate.duration_s;
  config.spin_hz = options.simulate.spin_hz;
  config.speed_mps = options.simulate.speed_mps;
  config.yaw_rate_radps = beams::deg_to_rad(options.simulate.yaw_rate_dps);
  config.effects.range_noise_m = options.simulate.noise_m;
  config.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 64U));
  config.sensor = sensor_config(options, EncoderTraits{});
  const auto mount = mount_of(options.mount);
  if (!mount) return tl::unexpected(mount.error());
  config.mount = *mount;
  auto calibration = made_calibration(options.capture, EncoderTraits{});
  if (!calibration) return tl::unexpected(calibration.error());
  config.calibration = *std::move(calibration);
  return config;
}

template <class EncoderTraits>
ExitCode simulate(const Options& options, const std::filesystem::path& output) {
  const auto config = simulation_config<EncoderTraits>(options);
  if (!config) return refuse(config.error());
  auto writer =
      drive::DriveWriter<EncoderTraits>::create(output, config->calibration, config->sensor);
  if (!writer) return refuse(writer.error());

  Progress progress("simulating", "seconds", options.simulate.duration_s);
  const auto simulated = simulator::simulate_drive(
      *config, [&](const simulator::SimulatedColumn<EncoderTraits>& column) -> Status {
        if (Status status = go_on(); !status) return status;
        progress.update(column.time_s);
        return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                  column.wire.by_laser);
      });
  if (!simulated) return refuse_work(simulated.error());
  const auto written = writer->finish();
  if (!written) return refuse(written.error());
  if (options.can_log) {
    const auto samples = simulator::simulated_motion(*config);
    if (!samples) return refuse(samples.error());
    const Status logged = drive::write_vehicle_log(output, *samples);
    if (!logged) return refuse(logged.error());
  }

  fmt::print("scene     {}, seed {}\n", options.simulate.scene, options.simulate.seed);
  if (!options.written.empty()) fmt::print("{}", wrote_drive(options));
  fmt::print("frames    {}\nreturns   {}\npackets   {}\n", written->frames, written->returns,
             written->packets);
  std::fflush(stdout);
  return kOk;
}

ExitCode simulate_to(const Options& options, const std::filesystem::path& output) {
  return drive::with_encoder_traits(
      options.capture.sensor.value_or(sensor::SensorModel::kHdl64e),
      [&](auto traits) { return simulate<decltype(traits)>(options, output); });
}

}  // namespace

ExitCode run_simulate(const Options& options) {
  catch_stop_signals();
  if (options.send.to.empty()) {
    if (options.written.empty()) {
      return refuse(kUsage, "nothing to do: -o FILE writes the drive, --udp ADDRESS:PORT sends it");
    }
    return simulate_to(options, options.written);
  }
  // Rays take longer to trace than a frame lasts: the drive is computed first, then sent on time.
  std::optional<TemporaryFolder> scratch;
  Options sending = options;
  sending.capture.file = options.written;
  if (sending.capture.file.empty()) {
    scratch.emplace();
    if (scratch->path().empty()) return refuse(kOutputFailed, "no temporary folder can be made");
    sending.capture.file = scratch->path() / "drive.pcap";
  }
  const ExitCode simulated = simulate_to(options, sending.capture.file);
  return simulated == kOk ? run_send(sending) : simulated;
}

}  // namespace terracut::cli
