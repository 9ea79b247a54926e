// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/beams/angle.hpp"
#include "firmware_io/decode/stream_tracker.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::decode {

/// Keeps packets that contradict the stream (Arrival::kDoubtful), with their bytes, until it is
/// known whether they are strays or begin another stream (Arrival::kNewStream). Real-time safe
/// except for the constructor. One thread.
class PacketsInDoubt {
 public:
  struct Packet {
    packet::PacketAzimuths azimuths;
    std::int64_t stamp_ns = 0;
    std::int64_t rotor_cdeg = 0;  ///< See Placement::rotor_cdeg.
    frame::Reject reason{};       ///< Why the packet is rejected if no others agree with it.
    std::span<const std::uint8_t> payload{};
  };

  /// `packet_bytes` is the size of a data packet.
  PacketsInDoubt(std::size_t packet_bytes, memory::FixedMemory& memory)
      : packet_bytes_(packet_bytes),
        packets_(memory.take<Packet>("packets in doubt", kMost)),
        bytes_(memory.take<std::uint8_t>("packets in doubt", kMost * packet_bytes)) {}

  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// Keeps a packet. Holds at most StreamTracker::kNewStream_packets; the last of them is the one
  /// that is kNewStream.
  void keep(const packet::Datagram& datagram, const packet::PacketAzimuths& azimuths,
            const Placement& placed) noexcept {
    const auto bytes = bytes_.subspan(size_ * packet_bytes_, packet_bytes_);
    std::ranges::copy(datagram.payload, bytes.begin());
    packets_[size_++] = {azimuths, datagram.stamp_ns, placed.rotor_cdeg, placed.reject, bytes};
  }
  /// Drops the packets as strays and counts each for its own reason.
  void drop(frame::LossCounters& losses) noexcept {
    for (const Packet& packet : packets_.first(size_)) {
      ++losses.rejected[static_cast<std::size_t>(packet.reason)];
    }
    size_ = next_ = 0;
  }

  /// Reads the packets as a new stream: returns the oldest not returned yet. When none is left,
  /// forgets all packets and returns null.
  [[nodiscard]] const Packet* take() noexcept {
    if (next_ < size_) return &packets_[next_++];
    size_ = next_ = 0;
    return nullptr;
  }
  /// True if `packet` lies more than a frame before the newest. Such a packet is left out, because
  /// decoding it would complete more frames at once than can be handed over.
  [[nodiscard]] bool is_too_old(const Packet& packet) const noexcept {
    return packet.rotor_cdeg < packets_[size_ - 1].rotor_cdeg - beams::kRevolution_cdeg;
  }

 private:
  static constexpr std::size_t kMost = StreamTracker::kNewStream_packets;

  std::size_t packet_bytes_;
  std::span<Packet> packets_;
  std::span<std::uint8_t> bytes_;  ///< The payloads of the packets kept.
  std::size_t size_ = 0;
  std::size_t next_ = 0;  ///< Index of the packet to be taken next.
};

}  // namespace terracut::decode
