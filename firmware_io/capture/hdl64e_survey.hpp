// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "firmware_io/hdl64e/wire.hpp"

namespace terracut::firmware_io {

enum class ReturnMode : std::uint8_t { kUnknown, kSingle, kDual };
[[nodiscard]] std::string_view to_string(ReturnMode mode) noexcept;

/// What the packets of one HDL-64E tell about it, all by the device's own stamps and azimuths.
struct Hdl64eFacts {
  std::uint64_t packets = 0;
  ReturnMode return_mode = ReturnMode::kUnknown;
  double packet_period_us = 0;         ///< Mean; 0 while unknown.
  double spin_rpm = 0;                 ///< 0 for a head that stands still.
  double step_deg = 0;                 ///< Azimuth from one column to the next, mean.
  double turns = 0;                    ///< Turned from the first packet to the last, gaps included.
  std::uint64_t packets_lost = 0;      ///< Missing by the device stamps.
  std::uint64_t packets_repeated = 0;  ///< With the stamp of the packet before.
  std::uint64_t packets_reordered = 0;
  std::uint64_t clock_jumps = 0;  ///< Stamp steps beyond 10 s either way: a loop, a restart.
  std::uint64_t azimuths_out_of_range = 0;  ///< Packets with an azimuth of 360 degrees or more.
  StatusSnapshot status;
  std::uint64_t status_rounds = 0;
  std::size_t status_holes = 0;                      ///< Bytes of the table that never came.
  std::optional<StatusTableCollector::Table> table;  ///< For calib::parse_stream_table().
};

/// Gathers Hdl64eFacts packet by packet. For inspection, not for the receive thread: allocates.
class Hdl64eSurvey {
 public:
  /// A packet for which is_hdl64e() holds.
  void add(const Hdl64ePacketView& packet);
  [[nodiscard]] Hdl64eFacts facts() const;

 private:
  /// Device time and azimuth between two packets next to each other in the capture.
  void add_step(const Hdl64ePacketView& packet);
  [[nodiscard]] double period_us() const;

  Hdl64eFacts facts_;
  StatusStreamReader status_;

  std::optional<std::uint32_t> newest_stamp_us_;
  int newest_azimuth_cdeg_ = 0;
  std::map<std::int64_t, std::uint64_t> steps_us_;  ///< How often stamps advanced by how much.
  std::int64_t short_time_us_ = 0;  ///< Over steps short enough to know the azimuth advance.
  std::int64_t short_advance_cdeg_ = 0;
  std::int64_t long_time_us_ = 0;         ///< Over the others.
  std::int64_t inside_advance_cdeg_ = 0;  ///< From first to last column of packets.
  std::uint64_t dual_packets_ = 0;
  std::uint64_t turning_packets_ = 0;
};

}  // namespace terracut::firmware_io
