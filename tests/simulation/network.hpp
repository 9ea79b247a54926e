// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "firmware_io/net/receive_counters.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "tests/simulation/dice.hpp"
#include "tests/simulation/fault.hpp"
#include "tests/simulation/machine.hpp"
#include "tests/simulation/sensor_loop.hpp"

namespace terracut::simulation {

/// A sensor, a cable that faults may befall, and the kernel's buffer at its end: what
/// net::LiveSource is to a live run. A net::DatagramSource.
class Network {
 public:
  /// All arguments must outlive this object. The kernel's buffer holds `room_packets`.
  Network(const SensorLoop& loop, const BlindPlaces& blind, const Faults& faults, Machine& machine,
          std::size_t room_packets, std::uint64_t seed);

  /// Lets the sensor begin with the first packet of the loop instead of any.
  void begin_with_first_packet() noexcept { sensor_place_ = 0; }

  [[nodiscard]] std::span<const packet::Datagram> receive(std::int64_t timeout_ns) noexcept;
  void wake() const noexcept {}
  void refresh_drops() noexcept { counters_.kernel_drops = truth_.dropped; }
  [[nodiscard]] const net::ReceiveCounters& counters() const noexcept { return counters_; }
  [[nodiscard]] net::LinkState link() const noexcept { return link_; }
  [[nodiscard]] std::size_t room_packets() const noexcept { return room_packets_; }

  /// The truth, to judge by: what became of datagrams on their way.
  struct Truth {
    std::uint64_t taken = 0;    ///< By the kernel's buffer.
    std::uint64_t dropped = 0;  ///< By the kernel, for want of room.
    std::uint64_t foreign = 0, of_wrong_size = 0, repeated = 0;  ///< Of those taken.
    std::uint64_t packets_lost = 0;  ///< The sensor's: lost, dropped, or of wrong size.
  };
  [[nodiscard]] const Truth& truth() const noexcept { return truth_; }
  [[nodiscard]] std::size_t waiting() const noexcept { return buffer_.size(); }
  struct Came {
    std::int64_t stamp_ns = 0, arrival_ns = 0;
    std::size_t place = 0;  ///< In the loop.
  };
  /// Returns the sensor's packet with this stamp, if it is among the newest 16,384.
  [[nodiscard]] std::optional<Came> packet_of(std::int64_t stamp_ns) const noexcept;

 private:
  enum class Kind : std::uint8_t { kData, kTruncated, kStanding, kTwin, kGarbage, kForeign };
  struct Sent {
    std::int64_t arrival_ns = 0;
    std::uint64_t number = 0;  ///< Orders what arrives at once.
    Kind kind = Kind::kData;
    std::size_t place = 0;  ///< In the loop.
    std::int64_t device_us = 0;
    std::int64_t stamp_ns = 0;  ///< The kernel's.
    bool is_again = false;      ///< Sent before.
    [[nodiscard]] bool operator>(const Sent& other) const noexcept {
      return arrival_ns != other.arrival_ns ? arrival_ns > other.arrival_ns : number > other.number;
    }
  };
  /// What the network has done of a fault.
  struct Done {
    bool begun = false;
    std::int64_t count = 0;
    std::int64_t next_ns = 0;  ///< When another sender's next datagram is due.
  };

  /// Moves what has arrived by `at_ns` into the kernel's buffer.
  void deliver_to(std::int64_t at_ns);
  /// Returns when the next datagram arrives, or `limit_ns` if none does before.
  [[nodiscard]] std::int64_t next_arrival_ns(std::int64_t limit_ns);
  [[nodiscard]] std::int64_t next_sent_ns() const noexcept;
  void send_next();
  void send_packet(std::int64_t at_ns);
  /// True if the sensor goes off now; it then begins anew.
  [[nodiscard]] bool restarts(std::int64_t at_ns) noexcept;
  void send_of_others(std::int64_t at_ns);
  void put(Sent sent);
  [[nodiscard]] bool take_one(std::size_t fault, std::int64_t at_ns) noexcept;
  [[nodiscard]] std::int64_t device_us(std::int64_t at_ns) const noexcept;
  [[nodiscard]] bool is_on(FaultKind kind, std::int64_t at_ns) const noexcept;
  [[nodiscard]] std::span<const std::uint8_t> write(const Sent& sent, std::size_t slot) noexcept;

  const SensorLoop& loop_;
  BlindPlaces blind_;
  const Faults& faults_;
  Machine& machine_;
  std::size_t room_packets_;
  Dice dice_;

  std::vector<Done> done_;  ///< By fault.
  std::int64_t sensor_next_ns_ = 0;
  std::size_t sensor_place_ = 0;
  std::int64_t booted_ns_, boot_us_;  ///< The device's clock showed boot_us_ then.
  std::uint64_t numbers_ = 0;
  std::priority_queue<Sent, std::vector<Sent>, std::greater<>> under_way_;

  std::deque<Sent> buffer_;
  Truth truth_;
  std::int64_t quiet_since_ns_ = 0;
  net::ReceiveCounters counters_;
  net::LinkState link_ = net::LinkState::kUp;
  std::array<SensorLoop::Packet, net::kBatchDatagrams> bytes_{};
  std::array<packet::Datagram, net::kBatchDatagrams> datagrams_{};

  std::vector<Came> came_ = std::vector<Came>(16'384);
  std::size_t next_came_ = 0;
};
static_assert(net::DatagramSource<Network>);

}  // namespace terracut::simulation
