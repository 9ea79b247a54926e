// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/sensor_recognition.hpp"

namespace terracut::streams {

/// The destination of a sender's datagrams.
struct Destination {
  std::uint32_t address = 0;  ///< IPv4, see Datagram.
  std::uint16_t port = 0;
  std::uint32_t vlan = 0;  ///< See Datagram.

  friend auto operator<=>(const Destination&, const Destination&) = default;
};

[[nodiscard]] constexpr Destination destination_of(const packet::Datagram& datagram) noexcept {
  return {datagram.destination_address, datagram.destination_port, datagram.vlan};
}

/// Identifies the data packets of one sensor among those from its address.
struct SensorStream {
  std::uint32_t source_address = 0;  ///< IPv4, see Datagram.
  sensor::SensorModel model{};
  /// One destination, or several that get the same packets or a part of them each; that with the
  /// most packets first.
  std::vector<Destination> destinations{};
  /// The source port and link-layer address, as in Datagram; set only if needed to tell this sensor
  /// from another.
  std::optional<std::uint16_t> source_port{};
  std::optional<std::uint64_t> source_mac{};
  std::uint64_t packets = 0;
  /// True if the packets contradict each other: they are of several sensors that cannot be told
  /// apart.
  bool contradicts_itself = false;

  /// True if a datagram from the sensor's address may be this sensor's. False for a data packet of
  /// another source port, link-layer address or destination.
  [[nodiscard]] bool may_hold(const packet::Datagram& datagram) const noexcept {
    const bool is_its_way =
        std::ranges::find(destinations, destination_of(datagram)) != destinations.end() &&
        (!source_port || *source_port == datagram.source_port) &&
        (!source_mac || *source_mac == datagram.source_mac);
    return is_its_way || sensor::recognise_sensor_as(model, datagram.payload) != model;
  }
};

/// Removes senders of stray packets: those with less than a hundredth of the busiest one's packets.
inline void drop_strays(std::vector<SensorStream>& sensors) {
  constexpr std::uint64_t kStrayShare = 100;
  std::uint64_t most = 0;
  for (const SensorStream& sensor : sensors) most = std::max(most, sensor.packets);
  std::erase_if(sensors, [&](const auto& sensor) { return sensor.packets * kStrayShare < most; });
}

}  // namespace terracut::streams
