// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/sensor_model.hpp"

namespace terracut::streams {

/// Where datagrams of one sender go to.
struct Destination {
  std::uint32_t address = 0;  ///< IPv4, as in Datagram.
  std::uint16_t port = 0;
  std::uint32_t vlan = 0;  ///< As in Datagram.

  friend auto operator<=>(const Destination&, const Destination&) = default;
};

[[nodiscard]] constexpr Destination destination_of(const packet::Datagram& datagram) noexcept {
  return {datagram.destination_address, datagram.destination_port, datagram.vlan};
}

/// The data packets of one sensor among those that came from its address.
struct SensorStream {
  std::uint32_t source_address = 0;  ///< IPv4, as in Datagram.
  sensor::SensorModel model{};
  /// One, or several that get the same packets, or of which each gets a part of them; the one of
  /// most packets first.
  std::vector<Destination> destinations{};
  /// Where it is by these alone that it is told from another sensor; as in Datagram.
  std::optional<std::uint16_t> source_port{};
  std::optional<std::uint64_t> source_mac{};
  std::uint64_t packets = 0;
  /// As the packets of several sensors do, which nothing else tells apart.
  bool contradicts_itself = false;

  /// Whether a datagram of its address may be its own: not where it is a data packet of such a
  /// sensor that went elsewhere, or came from elsewhere.
  [[nodiscard]] bool may_hold(const packet::Datagram& datagram) const noexcept {
    const bool is_its_way =
        std::ranges::find(destinations, destination_of(datagram)) != destinations.end() &&
        (!source_port || *source_port == datagram.source_port) &&
        (!source_mac || *source_mac == datagram.source_mac);
    return is_its_way || sensor::recognise_sensor_as(model, datagram.payload) != model;
  }
};

/// Leaves out who sent but stray packets: less than a hundredth of what the one heard most did.
inline void drop_strays(std::vector<SensorStream>& sensors) {
  constexpr std::uint64_t kStrayShare = 100;
  std::uint64_t most = 0;
  for (const SensorStream& sensor : sensors) most = std::max(most, sensor.packets);
  std::erase_if(sensors, [&](const auto& sensor) { return sensor.packets * kStrayShare < most; });
}

}  // namespace terracut::streams
