// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/hesai/models.hpp"
#include "firmware_io/robosense/models.hpp"
#include "firmware_io/velodyne/models.hpp"
#include "tools/lab/packets/hdl64e_encoder_traits.hpp"
#include "tools/lab/packets/ouster_encoder_traits.hpp"
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
///   of a sensor whose columns are numbered, these three stand for the two:
///   `firing_ns(calibration)`, `columns_per_frame(returns, spin_hz)`, and
///   `numbered_cdeg(calibration, number)`, the azimuth as sent of a column, of which a group begins
///   at multiples of its firings. Its calibration says at what rate it turns and how many returns
///   it sends: `unit_in_mode(calibration, returns, spin_hz)` changes that;
/// - `step_ticks(rotor, place, returns)`: the step by which the decoder computes the beams of
///   the firing at `place` of a group, given the group's azimuths;
/// - `advance_ticks(step_ticks, laser, returns)`: the head's azimuth at the laser's firing, minus
///   that of its column;
/// - `offset_ticks(offsets, step_ticks, laser, returns)`: the beam's azimuth, minus that of its
///   column;
/// - `offsets(calibration)`, `geometry(calibration, config)`, `nominal()`,
///   `metres_per_count(calibration)`, `widest_offset_rad(calibration)`;
/// - `kStrongestFirst`: the order of two returns;
/// - `kSecondIsLast`: the other return is the last one, and the same where there is but one;
///   otherwise it is the second strongest, and missing where there is but one;
/// - `kBeamHalfWidth_rad`: half the width of the light;
/// - `kCalibrationSuffix`, `read_calibration(path)`, `write_calibration(path, calibration)`: the
///   unit's table as a file. If the decoder has nominal() built in, the suffix is empty and the two
///   functions are missing;
/// - `sender(calibration, config)`: returns a `Sender`, which makes packets and writes them into a
///   capture (tools/lab/packets/hdl64e_packet_sender.hpp).

/// Expands INSTANTIATE(EncoderTraits) for each sensor whose packets are made.
#define TERRACUT_FOR_ENCODER_TRAITS(INSTANTIATE)                                        \
  INSTANTIATE(terracut::packets::Hdl64eEncoderTraits)                                   \
  INSTANTIATE(terracut::packets::Ruby128EncoderTraits)                                  \
  TERRACUT_FOR_VELODYNE_MODELS(INSTANTIATE, terracut::packets::VelodyneEncoderTraits)   \
  TERRACUT_FOR_HESAI_MODELS(INSTANTIATE, terracut::packets::HesaiEncoderTraits)         \
  TERRACUT_FOR_ROBOSENSE_MODELS(INSTANTIATE, terracut::packets::RoboSenseEncoderTraits) \
  INSTANTIATE(terracut::packets::OusterEncoderTraits<32>)                               \
  INSTANTIATE(terracut::packets::OusterEncoderTraits<64>)                               \
  INSTANTIATE(terracut::packets::OusterEncoderTraits<128>)

namespace terracut::packets {

template <class EncoderTraits>
inline constexpr bool kHasNumberedColumns =
    requires(const typename EncoderTraits::Calibration& unit, std::int64_t number) {
      EncoderTraits::numbered_cdeg(unit, number);
    };

/// Returns the columns of a frame's image: one for each firing of a laser.
template <class EncoderTraits>
[[nodiscard]] int image_columns(double spin_hz, ReturnMode returns) {
  if constexpr (kHasNumberedColumns<EncoderTraits>) {
    return EncoderTraits::columns_per_frame(returns, spin_hz);
  } else {
    const auto period_ns = static_cast<double>(EncoderTraits::laser_period_ns(returns));
    return static_cast<int>(std::lround(1e9 / (spin_hz * period_ns)));
  }
}

/// Returns the time from firing to firing of a unit.
template <class EncoderTraits>
[[nodiscard]] std::int64_t firing_ns(const typename EncoderTraits::Calibration& unit,
                                     ReturnMode returns) {
  if constexpr (kHasNumberedColumns<EncoderTraits>) {
    return EncoderTraits::firing_ns(unit);
  } else {
    return EncoderTraits::firing_ns(returns);
  }
}

/// Returns the unit measuring in a mode, if its calibration says in which; otherwise unchanged.
template <class EncoderTraits>
[[nodiscard]] typename EncoderTraits::Calibration unit_in_mode(
    const typename EncoderTraits::Calibration& unit, ReturnMode returns, double spin_hz) {
  if constexpr (kHasNumberedColumns<EncoderTraits>) {
    return EncoderTraits::unit_in_mode(unit, returns, spin_hz);
  } else {
    return unit;
  }
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
  if (robosense::Models::has(model)) {
    return robosense::Models::with(model, [&]<class Model>(std::type_identity<Model>) {
      return work(RoboSenseEncoderTraits<Model>{});
    });
  }
  if (velodyne::Models::has(model)) {
    return velodyne::Models::with(model, [&]<class Model>(std::type_identity<Model>) {
      return work(VelodyneEncoderTraits<Model>{});
    });
  }
  if (sensor::is_ouster(model)) {
    return ouster::Models::with(ouster::rows_of(model), [&](auto rows) {
      return work(OusterEncoderTraits<decltype(rows)::value>{});
    });
  }
  if (model == sensor::SensorModel::kRuby128) return work(Ruby128EncoderTraits{});
  return work(Hdl64eEncoderTraits{});
}

}  // namespace terracut::packets
