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
#include "firmware_io/frame/labelled_return.hpp"
#include "firmware_io/vehicle/motion_sample.hpp"
#include "rt/error.hpp"
#include "sensor_effects.hpp"
#include "tools/lab/packets/encoder_traits.hpp"

namespace terracut::simulator {

/// A drive to simulate, whatever the sensor. The same configuration gives the same drive, return by
/// return, with any compiler; a mathematical library that rounds differently may move a range by a
/// count now and then.
struct DriveConfig {
  std::string scene = "street";  ///< One of scene_names().
  std::uint64_t seed = 1;        ///< Of everything random: world, noise, drop-outs.
  double duration_s = 5.0;       ///< Rounded to whole frames, at least one; (0, 3600].
  double spin_hz = 10.0;         ///< [5, 20]
  double speed_mps = -1;         ///< Of the vehicle; < 0: what is usual in the scene; at most 60.
  /// Not 0: the vehicle turns at this rate all the time, on an arc that follows the road in the
  /// middle of the drive and leaves it towards both ends; [-1, 1], to the left is positive.
  double yaw_rate_radps = 0;
  mount::Mount mount;
  SensorEffects effects;
  /// The vehicle and everything else move on while the head rotates, as in life. When off, they
  /// stand still during each frame and jump between frames: frames are then as if motion were
  /// compensated.
  bool motion_within_frame = true;
  std::int64_t start_ns = 1'767'225'600'000'000'000;  ///< Of the first firing; 2026-01-01 UTC.
  int threads = 1;  ///< Rays are cast on so many threads; results do not depend on it; [1, 64].
};

/// The same with a sensor (tools/lab/drive/encoder_traits.hpp).
template <class EncoderTraits>
struct SimulationConfig : DriveConfig {
  typename EncoderTraits::Calibration calibration = EncoderTraits::nominal();
  typename EncoderTraits::Config sensor;  ///< Return mode, encodings.
};

/// One column of returns, as on the wire, and what it was made from.
template <class EncoderTraits>
struct SimulatedColumn {
  typename EncoderTraits::Column wire;
  double time_s = 0;  ///< Since the head passed straight ahead for the first time.
  /// Where each return lies in the sensor frame, noise included, before the wire's rounding to
  /// whole counts. Meaningless where by_laser[i].raw == 0.
  std::array<beams::Point, static_cast<std::size_t>(EncoderTraits::kLasers)> exact{};
};

/// Takes columns in firing order, whole packets in all; in dual return two a firing, in the
/// sensor's order. An error ends the drive and is handed on.
template <class EncoderTraits>
using ColumnSink = std::function<Status(const SimulatedColumn<EncoderTraits>&)>;

struct SimulationSummary {
  std::uint64_t frames = 0;
  std::uint64_t columns = 0;
  std::uint64_t returns = 0;
};

/// Simulates a drive and hands it to `sink`, column by column, from this thread.
///
/// Azimuths are rounded to the wire's 0.01 degrees first and rays cast at the rounded azimuth plus
/// firing advance, so that decoding the wire values gives `exact` back to within the rounding of
/// the range. The head starts some 11 degrees before straight ahead and ends as much after the last
/// frame; beams outside of the whole frames have no return, so every laser sees every frame whole
/// and there are no others.
///
/// In dual return a beam has a width: what lies behind an edge, a pole or a few leaves gives an
/// echo of its own. Where there is one echo, both returns are that one.
///
/// Errors: kInvalidArgument naming the setting, its value and the allowed range; those of `sink`.
/// Not real-time safe; allocates. A frame at 10 Hz takes 0.1 to 0.8 s on one core.
template <class EncoderTraits>
[[nodiscard]] Expected<SimulationSummary> simulate_drive(
    const SimulationConfig<EncoderTraits>& config,
    const std::type_identity_t<ColumnSink<EncoderTraits>>& sink);

/// How the vehicle of a drive moves, every `period_ns` from before its first firing to after its
/// last, stamped as its firings are. Errors as simulate_drive().
template <class EncoderTraits>
[[nodiscard]] Expected<std::vector<vehicle::MotionSample>> simulated_motion(
    const SimulationConfig<EncoderTraits>& config, std::int64_t period_ns = 10'000'000);

/// T_world_vehicle by stamps of the drive. Errors as simulate_drive().
template <class EncoderTraits>
[[nodiscard]] Expected<std::function<mount::RigidTransform(std::int64_t)>> simulated_poses(
    const SimulationConfig<EncoderTraits>& config);

using Hdl64eSimulation = SimulationConfig<packets::Hdl64eEncoderTraits>;
using Hdl64eSimulatedColumn = SimulatedColumn<packets::Hdl64eEncoderTraits>;

}  // namespace terracut::simulator
