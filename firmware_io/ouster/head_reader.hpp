// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/ouster/packet_reader.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ouster {

/// Reads the head's azimuths and times from the packets of a unit whose metadata is not known. How
/// many columns a frame has is not in the packets: until a frame's end has come they are taken to
/// be those of 10 Hz. One stream, one thread.
class HeadReader {
 public:
  /// As read_packet() does, for packets of so many rows.
  [[nodiscard]] std::optional<frame::Reject> read(std::span<const std::uint8_t> payload, int rows,
                                                  packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING;

 private:
  struct Seen {
    std::int64_t stamp_ns = 0;
    int measurement = 0;
  };
  /// Finds out how the unit measures from a packet after the last one.
  void learn(const PacketFormat& format, const PacketHead& head, std::int64_t column_ns) noexcept;

  Mode mode_;
  bool is_sure_ = false;  ///< True if the columns of a frame were seen.
  std::optional<Seen> last_;
};

}  // namespace terracut::ouster
