// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/beams/angle.hpp"
#include "firmware_io/capture/pcap_writer.hpp"
#include "firmware_io/hesai/models.hpp"
#include "firmware_io/hesai/stamp.hpp"
#include "firmware_io/packet/wire_integer.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "tools/lab/packets/return_mode.hpp"

namespace terracut::packets {

/// Writes the data packets of a Hesai into a capture, with the factory's addresses and ports. In
/// dual return the blocks of a pair are the last return, then the strongest. Fields that the
/// decoder does not read, checksums among them, are zeros. Writes a file, so it is not real-time
/// safe. One thread.
template <class Model>
class HesaiPacketSender {
 public:
  using Column = packets::LabelledColumn<Model::kChannels>;

  explicit HesaiPacketSender(ReturnMode returns) noexcept
      : is_dual_(returns == ReturnMode::kDual) {}

  /// Writes the next packet; `columns` fill it.
  [[nodiscard]] Status send(std::span<const Column> columns, int /*first_column*/,
                            capture::PcapWriter& capture) const {
    std::array<std::uint8_t, kLayout.packet_bytes()> bytes{};
    hesai::begin_packet(kLayout, is_dual_, bytes);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      fill(columns[c], std::span(bytes).subspan(kLayout.block_at(static_cast<int>(c))));
    }
    hesai::write_stamp_us(kLayout, columns.front().stamp_ns / 1000, bytes);
    return capture.write({.payload = bytes,
                          .stamp_ns = columns.back().stamp_ns + kLayout.column_ns,
                          .source_address = 0xC0A801C9,       // 192.168.1.201
                          .destination_address = 0xFFFFFFFF,  // broadcast
                          .source_port = 10'000,
                          .destination_port = hesai::kDataPort});
  }

 private:
  static constexpr const hesai::PacketLayout& kLayout = Model::kLayout;

  static void fill(const Column& column, std::span<std::uint8_t> block) noexcept {
    const auto put = [&](std::size_t at, std::uint16_t value) {
      std::ranges::copy(packet::Le16::of(value).bytes, block.subspan(at).begin());
    };
    put(kLayout.azimuth_at(),
        static_cast<std::uint16_t>(beams::wrap_cdeg(column.unwrapped_azimuth_cdeg)));
    std::size_t at = kLayout.returns_at();
    for (const LabelledReturn& beam : column.by_laser) {
      put(at, beam.raw);
      block[at + 2] = beam.intensity;
      at += kLayout.return_bytes;
    }
  }

  bool is_dual_;
};

}  // namespace terracut::packets
