// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

#include "calib/sensor_calibration.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/queues/spsc_queue.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::sensor {

/// Returns a warning if the packets contained a table other than the one in use: both fingerprints
/// and what to do. Empty if they contained no table, or the same one.
[[nodiscard]] std::string other_table_warning(const hdl64e::StatusStreamReader& told,
                                              const calib::SensorCalibration& in_use);

/// Reads the table in an HDL-64E's packets while another table is in use, to warn if the two
/// differ. One thread adds packets, another asks now and then; packets dropped in between come
/// again with the next round of the table.
class ToldTable {
 public:
  explicit ToldTable(memory::FixedMemory& memory) : heard_("table bytes", kHeard, memory) {}

  /// Takes a packet, on the receiving thread. Does nothing once the table is complete.
  void add(const packet::Datagram& datagram) noexcept TERRACUT_NONBLOCKING {
    if (told_.load(std::memory_order_relaxed)) return;
    const auto* packet = hdl64e::packet_in(datagram.payload);
    if (packet == nullptr || !hdl64e::is_hdl64e(*packet)) return;
    (void)heard_.try_push({packet->stamp_us.value(), packet->status_type, packet->status_value});
  }

  /// Returns the warning once; empty before and after, and if the tables agree. Any one thread
  /// without a deadline.
  [[nodiscard]] std::string take_warning(const calib::SensorCalibration& in_use);

 private:
  static constexpr std::size_t kHeard = 2048;  ///< Packets buffered: 0.3 s of dual return.

  struct StatusByte {
    std::uint32_t stamp_us;
    std::uint8_t type, value;
  };

  queues::SpscQueue<StatusByte> heard_;
  hdl64e::StatusStreamReader reader_;  ///< Used by the asking thread.
  std::atomic<bool> told_{false};
};

}  // namespace terracut::sensor
