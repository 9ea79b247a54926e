// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "calib/mount/mount.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/wire_returns.hpp"
#include "firmware_io/robosense/packet_reader.hpp"
#include "firmware_io/table/table_sensor.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::robosense {

/// The trait of a RoboSense with 32 lasers for the Decoder; `Model` as table::TableSensor says.
template <class Model>
class RoboSenseSensor : public table::TableSensor<Model> {
  using Table = table::TableSensor<Model>;

 public:
  using Config = ruby128::RubyClockConfig;
  static constexpr std::size_t kPacketBytes = robosense::kPacketBytes;
  static constexpr std::int64_t kClockWrap_us = robosense::kClockWrap_us;

  RoboSenseSensor(const typename Table::Calibration& calibration, const mount::Mount& mount,
                  const Config& config)
      : Table(calibration, mount), reader_(Model::kLayout, config.timestamp) {}

  [[nodiscard]] std::optional<frame::Reject> check(const packet::Datagram& datagram,
                                                   packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING {
    return reader_.read(datagram.payload, azimuths);
  }
  static void begin_packet(const packet::PacketAzimuths& /*azimuths*/) noexcept {}
  static void read_column(std::span<const std::uint8_t> payload, std::size_t column,
                          const typename Table::Returns& found) noexcept TERRACUT_NONBLOCKING {
    const std::uint8_t* const first =
        payload.data() + block_at(static_cast<int>(column)) + kReturnsAt;
    packet::split_returns(first, packet::ByteOrder::kBig, found.raw, &found.intensity[0]);
    if constexpr (Model::kLayout.resolution_at > 0) {
      if (payload[Model::kLayout.resolution_at] != 0) return;
      constexpr std::uint16_t kMost = 0xFFFF / 2;
      for (std::uint16_t& raw : found.raw) {
        raw = static_cast<std::uint16_t>(2 * std::min(raw, kMost));
      }
    }
  }

 private:
  PacketReader reader_;
};

}  // namespace terracut::robosense
