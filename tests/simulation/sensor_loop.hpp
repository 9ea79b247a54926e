// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "calib/sensor_calibration.hpp"

namespace terracut::simulation {

/// The packets of a few whole turns of a simulated drive, which a sensor sends over and over: the
/// head rotates on without a seam from the last to the first, as a turn has a whole number of
/// packets.
struct SensorLoop {
  static constexpr std::size_t kMostPacketBytes = 1206;
  using Packet = std::array<std::uint8_t, kMostPacketBytes>;

  calib::SensorCalibration calibration;
  mount::RingProfile profile;
  int columns = 0;  ///< Of the image.
  std::int64_t period_ns = 0;
  std::size_t packets_per_turn = 0;
  std::vector<Packet> packets;

  [[nodiscard]] std::size_t turns() const noexcept { return packets.size() / packets_per_turn; }
  [[nodiscard]] std::int64_t turn_ns() const noexcept {
    return period_ns * static_cast<std::int64_t>(packets_per_turn);
  }
};

/// Packets of each turn that the sensor does not send, because its view is limited there.
struct BlindPlaces {
  std::size_t first = 0, count = 0;

  [[nodiscard]] bool holds(std::size_t place, const SensorLoop& loop) const noexcept {
    return (place + loop.packets_per_turn - first) % loop.packets_per_turn < count;
  }
  friend auto operator<=>(const BlindPlaces&, const BlindPlaces&) = default;
};

/// Packets of a VLP-16, 75 a turn.
[[nodiscard]] const SensorLoop& vlp16_loop();
/// Packets of an HDL-64E, 375 a turn.
[[nodiscard]] const SensorLoop& hdl64e_loop();

/// Writes the device's clock, which wraps after an hour, into a packet.
void set_device_stamp(std::span<std::uint8_t> packet, std::int64_t device_us) noexcept;
/// Gives all blocks of a packet the azimuth of the first: the head stands.
void stop_head(std::span<std::uint8_t> packet) noexcept;

}  // namespace terracut::simulation
