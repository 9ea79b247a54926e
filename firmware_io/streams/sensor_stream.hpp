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

/// Where the datagrams of one sender go.
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
  /// One destination, or several that get the same packets or a part each; the one with most
  /// packets first.
  std::vector<Destination> destinations{};
  /// The source port and link-layer address, set only if needed to tell this sensor from another;
  /// see Datagram.
  std::optional<std::uint16_t> source_port{};
  std::optional<std::uint64_t> source_mac{};
  std::uint64_t packets = 0;
  /// True if the sensor's packets contradict each other: several sensors that nothing tells apart.
  bool contradicts_itself = false;

  /// True if a datagram from the sensor's address may be its own. False for a data packet that went
  /// to, or came from, another place than this sensor's.
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
