// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "calib/mount/mount.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/wire_returns.hpp"
#include "firmware_io/table/table_sensor.hpp"
#include "firmware_io/velodyne/packet_layout.hpp"
#include "firmware_io/velodyne/packet_reader.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::velodyne {

struct VelodyneConfig {
  bool is_named = false;  ///< See PacketReader.
};

/// The trait of a Velodyne sensor for the Decoder; `Model` as table::TableSensor says.
template <class Model>
class VelodyneSensor : public table::TableSensor<Model> {
  using Table = table::TableSensor<Model>;

 public:
  using Config = VelodyneConfig;
  static constexpr std::size_t kPacketBytes = velodyne::kPacketBytes;
  static constexpr std::int64_t kClockWrap_us = velodyne::kClockWrap_us;

  VelodyneSensor(const typename Table::Calibration& calibration, const mount::Mount& mount,
                 const Config& config)
      : Table(calibration, mount), reader_(Model::kLayout, config.is_named) {}

  [[nodiscard]] std::optional<frame::Reject> check(const packet::Datagram& datagram,
                                                   packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING {
    return reader_.read(datagram.payload, azimuths);
  }
  void begin_packet(const packet::PacketAzimuths& azimuths) noexcept {
    is_dual_packet_ = azimuths.dual_return;
  }
  void read_column(std::span<const std::uint8_t> payload, std::size_t column,
                   const typename Table::Returns& found) const noexcept TERRACUT_NONBLOCKING {
    const auto* packet = hdl64e::packet_in(payload);
    if (packet == nullptr) return;  // cannot happen: check() has accepted the packet
    for (int part = 0; part < Model::kLayout.blocks_per_column; ++part) {
      const std::size_t block =
          Model::kLayout.block(static_cast<int>(column), part, is_dual_packet_);
      const auto first = static_cast<std::size_t>(part * kBlockReturns);
      packet::split_returns(&packet->blocks[block].returns[0].distance.bytes[0],
                            packet::ByteOrder::kLittle, found.raw.subspan(first, kBlockReturns),
                            &found.intensity[first]);
    }
  }

 private:
  PacketReader reader_;
  bool is_dual_packet_ = false;
};

}  // namespace terracut::velodyne
