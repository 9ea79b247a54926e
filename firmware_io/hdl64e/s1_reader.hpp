// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>

#include "firmware_io/hdl64e/s1_packet.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::hdl64e {

/// Reads the packets of one HDL-64E S1, which sends no device stamps, and gives them stamps, so
/// that they are ordered and counted like those of other sensors. A packet's number is the number
/// of the last packet, plus the head's rotation since then divided by the rotation in one packet.
/// This is exact up to whole revolutions, which are taken from the host's stamps. The device stamp
/// is the number times the packet period.
///
/// Packets lost while the head stands still are not noticed.
///
/// One stream, one thread. noexcept, O(1).
class S1Reader {
 public:
  /// Checks a packet that came at `host_ns` by check_hdl64e_s1_packet(), and sets its device stamp.
  /// A packet with useless azimuths gets the stamp that the next packet should have.
  [[nodiscard]] std::optional<frame::Reject> read(const wire::Packet& packet, std::int64_t host_ns,
                                                  packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING;

 private:
  /// Returns the number of a packet (see above) while the head rotates.
  [[nodiscard]] std::int64_t number_of(const packet::PacketAzimuths& azimuths,
                                       std::int64_t host_ns) noexcept;
  void take(std::int64_t packet, std::int32_t azimuth_cdeg, std::int64_t host_ns) noexcept {
    packet_ = packet;
    azimuth_cdeg_ = azimuth_cdeg;
    host_ns_ = host_ns;
  }
  [[nodiscard]] std::int64_t mean_pace(std::int32_t pace_ticks) noexcept;
  [[nodiscard]] std::int64_t missing_revolutions(std::int64_t rotated_ticks,
                                                 std::int64_t pace_ticks,
                                                 std::int64_t host_ns) const noexcept;

  bool has_begun_ = false;
  std::int64_t packet_ = 0;
  std::int32_t azimuth_cdeg_ = 0;
  std::int64_t host_ns_ = 0;
  /// Sums of the rotation in a packet over some hundred packets, because encoder marks are coarse.
  std::int64_t paces_ticks_ = 0, paces_ = 0;
};

}  // namespace terracut::hdl64e
