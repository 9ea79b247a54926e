// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fault_script.hpp"
#include "firmware_io/packet/datagram.hpp"

namespace terracut::send {

/// The effects of one fault of a script so far, by packet.
struct FaultOutcome {
  /// Consecutive packets of the input stream, counted from 0.
  struct Run {
    std::uint64_t first = 0, count = 0;
    friend bool operator==(const Run&, const Run&) = default;
  };

  Fault fault;
  /// Packets lost, repeated, held back, cut, restamped or inserted; for a reordered packet, the
  /// number of later packets sent before it.
  std::uint64_t packets = 0;
  std::vector<Run> runs{};  ///< The affected packets; for foreign ones, the packet after them.

  /// True if the fault's time has come and all packets that it asks for were affected.
  [[nodiscard]] bool complete() const noexcept;
};

/// Applies a fault script to a stream of datagrams, between their source and a sender. The same
/// stream and script always give the same result. For tests and simulation: allocates. One thread.
class FaultInjector {
 public:
  enum class Origin : std::uint8_t { kSensor, kForeign };

  /// Receives the datagrams to be sent, in order. Their stamp is the time to send; it never falls
  /// unless the stream's own stamps do. The payload is valid only during the call.
  using Sink = std::function<void(const packet::Datagram&, Origin)>;
  /// Adds `shift_ns` to the device's stamp in a packet; false if it finds none. If the script has a
  /// clock fault, it is called for every remaining packet, with 0 before the jump.
  using ShiftStamp = std::function<bool(std::span<std::uint8_t> packet, std::int64_t shift_ns)>;

  static constexpr std::size_t kForeignBytes = 512;  ///< No data packet of a sensor has this size.

  FaultInjector(FaultScript script, Sink sink, ShiftStamp shift_stamp);

  void feed(const packet::Datagram& datagram);
  /// Ends the stream: sends all datagrams still held back.
  void finish();

  /// Returns one outcome for each fault, in the script's order.
  [[nodiscard]] std::span<const FaultOutcome> outcomes() const noexcept { return outcomes_; }
  /// Returns the number of packets whose stamp a clock fault could not shift.
  [[nodiscard]] std::uint64_t unshifted() const noexcept { return unshifted_; }
  [[nodiscard]] std::uint64_t fed() const noexcept { return fed_; }

 private:
  /// A datagram that waits for its time, with its bytes.
  struct Held {
    packet::Datagram datagram;
    std::vector<std::uint8_t> bytes;
    Origin origin = Origin::kSensor;
    std::uint64_t index = 0;
    std::size_t fault = 0;  ///< For a moved packet: index of the outcome that moves it.
  };

  [[nodiscard]] std::int64_t time_of(const packet::Datagram& datagram) const noexcept;
  void release_bursts(std::int64_t time_ns);
  void insert_foreign(const packet::Datagram& before);
  [[nodiscard]] bool take_away(std::int64_t time_ns);
  void edit(packet::Datagram& datagram);
  void shift_clock(std::int64_t time_ns, std::int64_t shift_ns);
  [[nodiscard]] bool move_back(const packet::Datagram& datagram);
  [[nodiscard]] bool is_duplicated(std::int64_t time_ns);
  void pass(const packet::Datagram& datagram, Origin origin, std::uint64_t index);
  void release_moved(const packet::Datagram& after);
  void let_go(Held& held, std::int64_t stamp_ns);

  std::vector<FaultOutcome> outcomes_;
  Sink sink_;
  ShiftStamp shift_stamp_;
  std::optional<std::int64_t> first_ns_;
  bool has_clock_fault_ = false;
  std::uint64_t fed_ = 0, unshifted_ = 0;
  std::uint64_t index_ = 0;  ///< Index of the current packet.
  std::vector<std::uint8_t> edited_;
  std::vector<Held> moved_;
  std::vector<Held> bursts_;  ///< Held packets in order of release.
};

}  // namespace terracut::send
