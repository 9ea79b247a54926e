// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "firmware_io/sensor/head_reader.hpp"
#include "sensor_stream.hpp"

namespace terracut::streams {

/// Finds out how many sensors of one model send from one address, and which packets belong to
/// which.
///
/// Packets to different destinations (address, port, VLAN) are of different sensors, unless one
/// destination gets copies of another's packets (a bridge, a mirror), or one stream is spread over
/// them. Packets of different source ports or link-layer addresses are of one sensor, which may
/// open a new socket for each, unless they contradict each other: one head has only one azimuth at
/// a time. This needs the sensor's clock; an HDL-64E S1 has none, so its packets count as one
/// sensor's.
///
/// For starts and reports: allocates, within bounds. One thread.
class SenderStreams {
 public:
  explicit SenderStreams(sensor::SensorModel model) : model_(model) {}

  /// Adds a data packet of the model from the address.
  void add(const packet::Datagram& datagram);

  /// Returns the sensors, those with most packets first.
  [[nodiscard]] std::vector<SensorStream> sensors() const;

 private:
  /// Most destinations kept: more are probably a port scan.
  static constexpr std::size_t kMostDestinations = 64;
  /// A packet is recognised as a copy within this many packets.
  static constexpr std::size_t kMostPayloads = 64;

  /// Counts packets that came from another source than the packet before, and how many of these
  /// contradict the packet before.
  struct Turns {
    std::uint64_t all = 0, contradicting = 0;

    void add(bool contradicts);
    [[nodiscard]] bool are_of_one_head() const { return contradicting * 4 < all; }
    [[nodiscard]] bool are_of_several() const;
  };
  /// The senders of the packets of one destination, told apart by a mark: source port or link-layer
  /// address.
  struct Sources {
    std::map<std::uint64_t, std::uint64_t> packets;  ///< Keyed by mark.
    std::uint64_t newest = 0;
    Turns turns;

    void add(std::uint64_t mark, std::optional<bool> contradicts);
    [[nodiscard]] bool tell_apart() const;
  };
  struct Place {
    std::uint64_t packets = 0;
    Sources ports, macs;
    Turns steps;  ///< Changes over all packets of the destination, whoever sent them.
    std::optional<std::int64_t> newest_us;  ///< Stamp of the newest packet on the sensor's clock.
  };
  using Group = std::vector<Destination>;

  [[nodiscard]] bool is_copy(const packet::Datagram& datagram);
  [[nodiscard]] bool are_copies(const Destination& a, const Destination& b) const;
  [[nodiscard]] bool is_one_stream_spread() const;
  [[nodiscard]] std::vector<Group> groups() const;
  void add_sensors_of(const Group& group, std::vector<SensorStream>& sensors) const;

  sensor::SensorModel model_;
  std::uint32_t source_address_ = 0;
  sensor::HeadReader reader_;
  std::map<Destination, Place> places_;
  Destination newest_;
  std::optional<std::int64_t> newest_us_;
  bool has_clock_ = false;     ///< False for simulators whose stamps are all the same.
  Turns turns_;                ///< Changes between destinations.
  std::uint64_t packets_ = 0;  ///< Number of packets, not counting copies.
  std::unordered_map<std::uint64_t, Destination> first_at_;  ///< Keyed by the payload's hash.
  std::deque<std::uint64_t> payloads_;  ///< The hashes in `first_at_`, oldest first.
  std::map<std::pair<Destination, Destination>, std::uint64_t> copies_;
};

}  // namespace terracut::streams
