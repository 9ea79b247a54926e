// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "calib/beams/beam.hpp"
#include "calib/mount/mount.hpp"
#include "firmware_io/vehicle/motion_sample.hpp"
#include "rt/error.hpp"
#include "sensor_effects.hpp"
#include "tools/lab/packets/encoder_traits.hpp"
#include "tools/lab/packets/labelled_return.hpp"

namespace terracut::simulator {

/// A drive to simulate, for any sensor. The same configuration gives the same drive, return by
/// return, with any compiler; a mathematical library that rounds differently may rarely move a
/// range by a count.
struct DriveConfig {
  std::string scene = "street";  ///< One of scene_names().
  std::uint64_t seed = 1;        ///< Seed of all random values: world, noise, drop-outs.
  double duration_s = 5.0;       ///< Rounded to whole frames, at least one; (0, 3600].
  double spin_hz = 10.0;         ///< [5, 20]
  double speed_mps = -1;         ///< Speed of the vehicle, at most 60; < 0: the scene's usual.
  /// If not 0, the vehicle turns at this constant rate, on an arc that follows the road in the
  /// middle of the drive and leaves it towards both ends; [-1, 1], positive to the left.
  double yaw_rate_radps = 0;
  mount::Mount mount;
  SensorEffects effects;
  /// True: vehicle and objects move while the head rotates. False: they stand still during each
  /// frame and jump between frames, as if motion were compensated.
  bool motion_within_frame = true;
  std::int64_t start_ns = 1'767'225'600'000'000'000;  ///< 2026-01-01 UTC, the first firing.
  int threads = 1;  ///< Threads that cast rays, without influence on results; [1, 64].
};

/// A drive with its sensor (tools/lab/packets/encoder_traits.hpp).
template <class EncoderTraits>
struct SimulationConfig : DriveConfig {
  typename EncoderTraits::Calibration calibration = EncoderTraits::nominal();
  typename EncoderTraits::Config sensor;  ///< Return mode, encodings.
};

/// One column of returns, as on the wire, and its origin.
template <class EncoderTraits>
struct SimulatedColumn {
  typename EncoderTraits::Column wire;
  double time_s = 0;  ///< Time since the head first pointed straight ahead.
  /// The point of each return in the sensor frame, with noise, before rounding to the wire's
  /// counts. Meaningless where wire.by_laser[i].raw == 0.
  std::array<beams::Point, static_cast<std::size_t>(EncoderTraits::kLasers)> exact{};
};

/// Takes columns in the order of firing, whole packets in all; in dual return two per firing, in
/// the sensor's order. An error ends the drive and is returned.
template <class EncoderTraits>
using ColumnSink = std::function<Status(const SimulatedColumn<EncoderTraits>&)>;

struct SimulationSummary {
  std::uint64_t frames = 0;
  std::uint64_t columns = 0;
  std::uint64_t returns = 0;
};

/// Simulates a drive and passes it to `sink`, column by column, on this thread.
///
/// Azimuths are first rounded to the wire's 0.01 degrees, and rays are cast at the rounded azimuth
/// plus the firing advance, so that decoding the wire values gives `exact` back to within the
/// rounding of the range. The head starts some 11 degrees before straight ahead and ends as much
/// after the last frame; beams outside the whole frames have no return, so all frames are whole for
/// every laser.
///
/// In dual return a beam has a width: a surface behind an edge, a pole or a few leaves gives a
/// second echo. If there is only one echo, the two returns are equal.
///
/// Fails with kInvalidArgument, naming the setting, its value and the allowed range, or with the
/// error of `sink`. Not real-time safe; allocates. A frame at 10 Hz takes 0.1 to 0.8 s on one core.
template <class EncoderTraits>
[[nodiscard]] Expected<SimulationSummary> simulate_drive(
    const SimulationConfig<EncoderTraits>& config,
    const std::type_identity_t<ColumnSink<EncoderTraits>>& sink);

/// Returns the motion of a drive's vehicle every `period_ns`, from before the first firing to after
/// the last, with stamps like those of firings. Fails as simulate_drive() does.
template <class EncoderTraits>
[[nodiscard]] Expected<std::vector<vehicle::MotionSample>> simulated_motion(
    const SimulationConfig<EncoderTraits>& config, std::int64_t period_ns = 10'000'000);

/// Returns a function that gives T_world_vehicle for a stamp of the drive. Fails as
/// simulate_drive() does.
template <class EncoderTraits>
[[nodiscard]] Expected<std::function<mount::RigidTransform(std::int64_t)>> simulated_poses(
    const SimulationConfig<EncoderTraits>& config);

using Hdl64eSimulation = SimulationConfig<packets::Hdl64eEncoderTraits>;
using Hdl64eSimulatedColumn = SimulatedColumn<packets::Hdl64eEncoderTraits>;

}  // namespace terracut::simulator
