// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "calib/mount/mount.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"

namespace terracut::decode {

/// What a sensor states to be decoded: all that differs from model to model, resolved at compile
/// time (hdl64e/hdl64e_sensor.hpp, ruby128/ruby128_sensor.hpp; table/table_sensor.hpp for those
/// with straight beams).
///
/// `kChannels` are the readings in a column, called lasers below: one for each laser, or more if a
/// laser fires more than once for one azimuth; a multiple of 8. Lasers that fire together are one
/// of `kGroups` groups. `kDefaultColumns` and `kDefaultReturnsPerCell` are Decoder::Config's for
/// single return at 10 Hz. The device clock counts [0, kClockWrap_us). `kPacketBytes` is the most
/// that a data packet has.
///
/// A sensor whose distances take more than 16 bits has a true `kHasFineDistances` and fills in
/// FiringReturns::fine; `metres_per_count` is that of the whole counts.
template <class Sensor>
concept SensorTrait =
    std::constructible_from<Sensor, const typename Sensor::Calibration&, const mount::Mount&,
                            const typename Sensor::Config&> &&
    std::copy_constructible<Sensor> && Sensor::kChannels % 8 == 0 &&
    Sensor::kChannels % Sensor::kRows == 0 &&
    requires(Sensor sensor, const Sensor& constant, const packet::Datagram& datagram,
             packet::PacketAzimuths& azimuths, std::span<const std::uint8_t> payload,
             std::size_t index, std::int32_t step_ticks,
             const packet::FiringReturns<static_cast<std::size_t>(Sensor::kChannels)>& found,
             const packet::LaserHeads& heads, const frame::TileRow<float>& measured_m,
             const frame::PointsOut& out) {
      requires std::same_as<decltype(Sensor::kPacketBytes), const std::size_t>;
      requires std::same_as<decltype(Sensor::kGroups), const std::size_t>;
      requires std::same_as<decltype(Sensor::kClockWrap_us), const std::int64_t>;
      requires std::same_as<decltype(Sensor::kDefaultColumns), const int>;
      requires std::same_as<decltype(Sensor::kDefaultReturnsPerCell), const int>;
      // Returns the reason to reject a packet, or reads its heads.
      { sensor.check(datagram, azimuths) } noexcept -> std::same_as<std::optional<frame::Reject>>;
      // The beams around the head.
      { constant.spread(step_ticks) } noexcept -> std::same_as<packet::BeamSpread>;
      // Azimuth of a laser's beam minus the head's when it fires.
      { constant.beam_ticks(0) } noexcept -> std::same_as<std::int32_t>;
      // The group of a laser.
      { constant.group(index) } noexcept -> std::same_as<std::size_t>;
      // How far the head has rotated from a firing's azimuth when the group fires, [0, 1e5].
      { constant.advance_ticks(step_ticks, index, true) } noexcept -> std::same_as<std::int32_t>;
      // To be called for each packet in order of arrival.
      { sensor.begin_packet(azimuths) } noexcept;
      // What advance_ticks() is to be called with for a column: the head's step; or, of a sensor
      // whose lasers fire at once, the rest of its azimuth below a hundredth of a degree.
      { constant.step_ticks(azimuths, index) } noexcept -> std::same_as<std::int32_t>;
      // Fills in a column's returns.
      { sensor.read_column(payload, index, found) } noexcept;
      { constant.metres_per_count() } noexcept -> std::same_as<float>;
      { constant.compute_points(index, heads, measured_m, out) } noexcept;
      // The range image row of each laser.
      { constant.rows()[index] } noexcept -> std::convertible_to<std::int32_t>;
    };

template <class Sensor>
inline constexpr bool kHasFineDistancesOf = requires { requires Sensor::kHasFineDistances; };

}  // namespace terracut::decode
