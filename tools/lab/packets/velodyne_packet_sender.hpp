// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/beams/angle.hpp"
#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/capture/pcap_writer.hpp"
#include "firmware_io/velodyne/packet_layout.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "tools/lab/packets/return_mode.hpp"

namespace terracut::packets {

/// Writes the data packets of a Velodyne with a built-in table into a capture, with the factory's
/// addresses and ports. In dual return the blocks of a pair are the last return, then the
/// strongest. Position packets are not written. Writes a file, so it is not real-time safe. One
/// thread.
template <class Model>
class VelodynePacketSender {
 public:
  using Column = packets::LabelledColumn<Model::kChannels>;

  explicit VelodynePacketSender(ReturnMode returns) noexcept
      : is_dual_(returns == ReturnMode::kDual) {}

  /// Writes the next packet; `columns` fill it.
  [[nodiscard]] Status send(std::span<const Column> columns, int /*first_column*/,
                            capture::PcapWriter& capture) const {
    const std::int64_t stamp_ns = columns.front().stamp_ns;
    hdl64e::wire::Packet packet{};
    packet.stamp_us = static_cast<std::uint32_t>(stamp_ns / 1000 % velodyne::kClockWrap_us);
    packet.status_type = is_dual_ ? velodyne::kDual : velodyne::kStrongest;
    packet.status_value = sensor::row_of(Model::kModel).product_number;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      for (int part = 0; part < Model::kLayout.blocks_per_column; ++part) {
        fill(columns[c], part,
             packet.blocks[Model::kLayout.block(static_cast<int>(c), part, is_dual_)]);
      }
    }
    return capture.write({.payload = hdl64e::payload_of(packet),
                          .stamp_ns = columns.back().stamp_ns + Model::kPace.column_ns,
                          .source_address = 0xC0A801C9,       // 192.168.1.201
                          .destination_address = 0xFFFFFFFF,  // broadcast
                          .source_port = hdl64e::kHdl64eDataPort,
                          .destination_port = hdl64e::kHdl64eDataPort});
  }

 private:
  static void fill(const Column& column, int part, hdl64e::wire::Block& block) noexcept {
    block.id = Model::kLayout.block_ids[static_cast<std::size_t>(part)];
    block.azimuth_cdeg =
        static_cast<std::uint16_t>(beams::wrap_cdeg(column.unwrapped_azimuth_cdeg));
    const auto first = static_cast<std::size_t>(part * velodyne::kBlockReturns);
    for (std::size_t i = 0; i < block.returns.size(); ++i) {
      const LabelledReturn& beam = column.by_laser[first + i];
      block.returns[i] = {packet::Le16::of(beam.raw), beam.intensity};
    }
  }

  bool is_dual_;
};

}  // namespace terracut::packets
