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

/// Where the packets told a table that is not the one in use: both fingerprints and what to do.
/// Empty where they told none, or this one.
[[nodiscard]] std::string other_table_warning(const hdl64e::StatusStreamReader& told,
                                              const calib::SensorCalibration& in_use);

/// Reads along what an HDL-64E's packets tell of its table while another source of it is in use, to
/// say when the two differ. Two threads: one adds, another one asks, now and then; what it is too
/// slow for comes by again with the next round of the table.
class ToldTable {
 public:
  explicit ToldTable(memory::FixedMemory& memory) : heard_("table bytes", kHeard, memory) {}

  /// Receiving thread. Nothing more is passed on once a table was told.
  void add(const packet::Datagram& datagram) noexcept TERRACUT_NONBLOCKING {
    if (told_.load(std::memory_order_relaxed)) return;
    const auto* packet = hdl64e::packet_in(datagram.payload);
    if (packet == nullptr || !hdl64e::is_hdl64e(*packet)) return;
    (void)heard_.try_push({packet->stamp_us.value(), packet->status_type, packet->status_value});
  }

  /// What there is to be said, once; empty before and after, and where nothing differs. Any one
  /// thread without a deadline.
  [[nodiscard]] std::string take_warning(const calib::SensorCalibration& in_use);

 private:
  static constexpr std::size_t kHeard = 2048;  ///< Packets: 0.3 s of dual return.

  struct StatusByte {
    std::uint32_t stamp_us;
    std::uint8_t type, value;
  };

  queues::SpscQueue<StatusByte> heard_;
  hdl64e::StatusStreamReader reader_;  ///< Of the thread that asks.
  std::atomic<bool> told_{false};
};

}  // namespace terracut::sensor
