// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "calib/beams/angle.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "pipeline/output/frame_folder.hpp"
#include "repeated_send.hpp"
#include "rt/files/whole_file.hpp"
#include "tools/cli/arguments/command_files.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/files/temporary_folder.hpp"
#include "tools/cli/settings/made_calibration.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/drive/vehicle_log.hpp"
#include "tools/lab/simulator/cloud_drive.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace terracut::cli {
namespace {

using packets::Hdl64eEncoderTraits;
using packets::Ruby128EncoderTraits;

Hdl64eEncoderTraits::Config sensor_config(const Options& options, Hdl64eEncoderTraits) {
  return {.returns = options.simulate.returns};
}
Ruby128EncoderTraits::Config sensor_config(const Options& options, Ruby128EncoderTraits) {
  Ruby128EncoderTraits::Config config;
  config.returns = options.simulate.returns;
  config.timestamp = options.simulate.timestamp;
  config.unit.rpm = static_cast<std::uint16_t>(std::lround(60 * options.simulate.spin_hz));
  config.unit.serial = {'S', 'I', 'M', 'U', 'L', 'A'};  // obviously not a real unit's serial number
  return config;
}
template <class Model, class Sender>
typename packets::TableEncoderTraits<Model, Sender>::Config sensor_config(
    const Options& options, packets::TableEncoderTraits<Model, Sender>) {
  return {.returns = options.simulate.returns};
}
template <int kRows>
typename packets::OusterEncoderTraits<kRows>::Config sensor_config(
    const Options& options, packets::OusterEncoderTraits<kRows>) {
  return {.returns = options.simulate.returns};
}

template <class EncoderTraits>
Expected<typename EncoderTraits::Calibration> unit_to_make(const Options& options,
                                                           EncoderTraits traits) {
  if constexpr (packets::kHasNumberedColumns<EncoderTraits>) {
    return made_calibration(options.capture, traits, options.simulate.product);
  } else {
    return made_calibration(options.capture, traits);
  }
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
  auto calibration = unit_to_make(options, EncoderTraits{});
  if (!calibration) return tl::unexpected(calibration.error());
  config.calibration =
      packets::unit_in_mode<EncoderTraits>(*calibration, config.sensor.returns, config.spin_hz);
  return config;
}

template <class EncoderTraits>
Expected<drive::DriveSummary> simulate(const Options& options,
                                       const std::filesystem::path& output) {
  const auto config = simulation_config<EncoderTraits>(options);
  if (!config) return tl::unexpected(config.error());
  auto writer =
      drive::DriveWriter<EncoderTraits>::create(output, config->calibration, config->sensor);
  if (!writer) return tl::unexpected(writer.error());

  Progress progress("simulating", "s", options.simulate.duration_s);
  const auto simulated = simulator::simulate_drive(
      *config, [&](const simulator::SimulatedColumn<EncoderTraits>& column) -> Status {
        if (Status status = go_on(); !status) return status;
        progress.update(column.time_s);
        return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                  column.wire.by_laser);
      });
  if (!simulated) return tl::unexpected(simulated.error());
  auto written = writer->finish();
  if (!written || !options.can_log) return written;
  const auto samples = simulator::simulated_motion(*config);
  if (!samples) return tl::unexpected(samples.error());
  const Status logged = drive::write_vehicle_log(output, *samples);
  if (!logged) return tl::unexpected(logged.error());
  return written;
}

/// Writes the clouds of a sensor without rows as a SemanticKITTI sequence.
ExitCode simulate_clouds(const Options& options) {
  simulator::CloudDriveConfig config{.scene = options.simulate.scene,
                                     .seed = options.simulate.seed,
                                     .duration_s = options.simulate.duration_s,
                                     .clouds_hz = options.simulate.spin_hz,
                                     .speed_mps = options.simulate.speed_mps};
  config.effects.range_noise_m = options.simulate.noise_m;
  const auto mount = mount_of(options.mount);
  if (!mount) return refuse_work(mount.error());
  config.mount = *mount;
  const auto folder = [&](const char* name, const char* ending) {
    return output::FrameFolder({.folder = options.written / name,
                                .ending = ending,
                                .replaces_others = options.output.overwrite});
  };
  output::FrameFolder scans = folder("velodyne", ".bin"), truth = folder("labels", ".label");
  Progress progress("simulating", "s", config.duration_s);
  std::size_t clouds = 0, points = 0;
  const Status simulated = simulator::simulate_clouds(
      config, *simulator::shot_pattern(options.simulate.pattern),
      [&](const simulator::SimulatedCloud& cloud) -> Status {
        if (Status status = go_on(); !status) return status;
        const std::string name = fmt::format("{:06}", clouds);
        const auto scan_path = scans.place(name + ".bin");
        if (!scan_path) return tl::unexpected(scan_path.error());
        const auto truth_path = truth.place(name + ".label");
        if (!truth_path) return tl::unexpected(truth_path.error());
        Status written = files::write_whole_file(*scan_path, std::as_bytes(cloud.points));
        if (written) written = scan::write_label_ids(*truth_path, cloud.truth);
        points += cloud.points.size();
        progress.update(static_cast<double>(++clouds) / config.clouds_hz);
        return written;
      });
  if (!simulated) return refuse_work(simulated.error());
  print_out("scene     {}, seed {}\n", config.scene, config.seed);
  print_text(wrote_drive(options));
  print_out("clouds    {}\npoints    {}\n", clouds, points);
  static_cast<void>(flush_output());
  return kOk;
}

Expected<drive::DriveSummary> simulate_to(const Options& options,
                                          const std::filesystem::path& output) {
  return packets::with_encoder_traits(
      options.capture.sensor.value_or(sensor::SensorModel::kHdl64e),
      [&](auto traits) { return simulate<decltype(traits)>(options, output); });
}

ExitCode simulate_and_say(const Options& options, const std::filesystem::path& output) {
  const auto made = simulate_to(options, output);
  if (!made) return refuse_work(made.error());
  print_out("scene     {}, seed {}\n", options.simulate.scene, options.simulate.seed);
  if (!options.written.empty()) print_text(wrote_drive(options));
  print_out("frames    {}\nreturns   {}\npackets   {}\n", made->frames, made->returns,
            made->packets);
  static_cast<void>(flush_output());
  return kOk;
}

/// Returns the length of the first part of the drive, which is computed first and sent repeatedly
/// while the rest is computed, so that the sensor is heard within seconds: ray casting takes longer
/// than real time. This part contains the unit's whole table (1.2 s for an HDL-64E).
double beginning_s(const Options& options) {
  return options.capture.sensor.value_or(sensor::SensorModel::kHdl64e) ==
                 sensor::SensorModel::kHdl64e
             ? 1.3
             : 0.4;
}

ExitCode simulate_sending_the_beginning(const Options& options, const std::filesystem::path& folder,
                                        const std::filesystem::path& drive) {
  Options beginning = options;
  beginning.simulate.duration_s = beginning_s(options);
  beginning.can_log = false;
  beginning.send.faults.clear();
  beginning.capture.file = folder / "beginning.pcap";
  const auto begun = simulate_to(beginning, beginning.capture.file);
  if (!begun) return refuse_work(begun.error());
  say(fmt::format("sending the first {} s over and over, until all of the drive is computed",
                  beginning_s(options)));
  std::atomic<bool> is_computed{false};
  ExitCode simulated = kOk;
  std::jthread computing([&] {
    (void)::setpriority(PRIO_PROCESS, 0, 10);  // this thread only: packets must go out on time
    simulated = simulate_and_say(options, drive);
    is_computed = true;
  });
  const Status sent = send_until(beginning, is_computed);
  computing.join();
  if (simulated != kOk) return simulated;
  return done_or_refused(sent);
}

}  // namespace

ExitCode run_simulate(const Options& options) {
  catch_stop_signals();
  if (!options.simulate.pattern.empty()) return simulate_clouds(options);
  if (options.send.to.empty()) {
    if (options.written.empty()) {
      return refuse(kUsage, "nothing to do: -o FILE writes the drive, --udp ADDRESS:PORT sends it");
    }
    return simulate_and_say(options, options.written);
  }
  const TemporaryFolder scratch;
  if (scratch.path().empty()) return refuse(kOutputFailed, "no temporary folder can be made");
  Options sending = options;
  sending.capture.file = options.written.empty() ? scratch.path() / "drive.pcap" : options.written;
  const bool is_short = options.simulate.duration_s < 2 * beginning_s(options);
  const ExitCode simulated =
      is_short ? simulate_and_say(options, sending.capture.file)
               : simulate_sending_the_beginning(options, scratch.path(), sending.capture.file);
  return simulated == kOk ? run_send(sending) : simulated;
}

}  // namespace terracut::cli
