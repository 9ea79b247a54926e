// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <type_traits>

#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/hesai/models.hpp"
#include "firmware_io/velodyne/models.hpp"
#include "tools/lab/packets/hdl64e_encoder_traits.hpp"
#include "tools/lab/packets/return_mode.hpp"
#include "tools/lab/packets/ruby128_encoder_traits.hpp"
#include "tools/lab/packets/table_encoder_traits.hpp"

/// An `EncoderTraits` describes a sensor to the makers of packets (DriveWriter, the simulator), as
/// `Sensor` does to a decoder. Templates are instantiated for those in TERRACUT_FOR_ENCODER_TRAITS.
/// An `EncoderTraits` has
/// - the types `Calibration`, `Geometry`, `Offsets` (of the beams), `Config` with `returns`, and
///   `Column`, a LabelledColumn of its `kLasers`;
/// - `columns_per_packet(returns)`;
/// - `firings_per_group(returns)`: the fewest firings that fill whole packets. A group of several
///   packets shares a firing between them;
/// - `firing_ns(returns)`: the time from firing to firing;
/// - `laser_period_ns(returns)`: the time from a laser's firing to its next;
/// - `step_ticks(rotor, place, returns)`: the step by which the decoder computes the beams of
///   the firing at `place` of a group, given the group's azimuths;
/// - `advance_ticks(step_ticks, laser, returns)`: the head's azimuth at the laser's firing, minus
///   that of its column;
/// - `offset_ticks(offsets, step_ticks, laser, returns)`: the beam's azimuth, minus that of its
///   column;
/// - `offsets(calibration)`, `geometry(calibration, config)`, `nominal()`,
///   `metres_per_count(calibration)`, `widest_offset_rad(calibration)`;
/// - `kStrongestFirst`: the order of two returns;
/// - `kBeamHalfWidth_rad`: half the width of the light;
/// - `kCalibrationSuffix`, `read_calibration(path)`, `write_calibration(path, calibration)`: the
///   unit's table as a file. If the decoder has nominal() built in, the suffix is empty and the two
///   functions are missing;
/// - `sender(calibration, config)`: returns a `Sender`, which makes packets and writes them into a
///   capture (tools/lab/packets/hdl64e_packet_sender.hpp).

/// Expands INSTANTIATE(EncoderTraits) for each sensor whose packets are made.
#define TERRACUT_FOR_ENCODER_TRAITS(INSTANTIATE)                                      \
  INSTANTIATE(terracut::packets::Hdl64eEncoderTraits)                                 \
  INSTANTIATE(terracut::packets::Ruby128EncoderTraits)                                \
  TERRACUT_FOR_VELODYNE_MODELS(INSTANTIATE, terracut::packets::VelodyneEncoderTraits) \
  TERRACUT_FOR_HESAI_MODELS(INSTANTIATE, terracut::packets::HesaiEncoderTraits)

namespace terracut::packets {

/// Returns the columns of a frame's image: one for each firing of a laser.
template <class EncoderTraits>
[[nodiscard]] int image_columns(double spin_hz, ReturnMode returns) {
  const auto period_ns = static_cast<double>(EncoderTraits::laser_period_ns(returns));
  return static_cast<int>(std::lround(1e9 / (spin_hz * period_ns)));
}

/// Calls `work` with the trait (an empty object) of the model; with the HDL-64E's for a model whose
/// packets cannot be made.
template <class Work>
decltype(auto) with_encoder_traits(sensor::SensorModel model, const Work& work) {
  if (hesai::Models::has(model)) {
    return hesai::Models::with(model, [&]<class Model>(std::type_identity<Model>) {
      return work(HesaiEncoderTraits<Model>{});
    });
  }
  if (velodyne::Models::has(model)) {
    return velodyne::Models::with(model, [&]<class Model>(std::type_identity<Model>) {
      return work(VelodyneEncoderTraits<Model>{});
    });
  }
  if (model == sensor::SensorModel::kRuby128) return work(Ruby128EncoderTraits{});
  return work(Hdl64eEncoderTraits{});
}

}  // namespace terracut::packets
