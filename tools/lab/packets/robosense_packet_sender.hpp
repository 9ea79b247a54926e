// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/beams/angle.hpp"
#include "calib/beams/beam_table.hpp"
#include "firmware_io/capture/pcap_writer.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/packet/wire_integer.hpp"
#include "firmware_io/robosense/models.hpp"
#include "firmware_io/ruby128/difop_angles.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "tools/lab/packets/return_mode.hpp"

namespace terracut::packets {

/// Writes the data packets of a RoboSense with 32 lasers into a capture, with the factory's
/// addresses and ports, and once a second a DIFOP packet with the unit's angles. In dual return the
/// blocks of a pair are the strongest return, then the second. Writes a file, so it is not
/// real-time safe. One thread.
template <class Model>
class RoboSensePacketSender {
 public:
  using Column = packets::LabelledColumn<Model::kChannels>;

  RoboSensePacketSender(const beams::BeamTable& table, ReturnMode returns) noexcept {
    // 0 is dual, 4 strongest, of a Helios; 1 of an RS-LiDAR-32.
    constexpr std::uint8_t kStrongest = Model::kModel == sensor::SensorModel::kHelios ? 4 : 1;
    difop_.return_mode = returns == ReturnMode::kDual ? std::uint8_t{0} : kStrongest;
    difop_.rpm_set = packet::Be16::of(600);
    difop_.data_port = packet::Be16::of(ruby128::kRubyDataPort);
    difop_.device_port = packet::Be16::of(ruby128::kRubyDevicePort);
    ruby128::set_table(difop_, table);
  }

  /// Writes the next packet; `columns` fill it.
  [[nodiscard]] Status send(std::span<const Column> columns, int /*first_column*/,
                            capture::PcapWriter& capture) {
    const std::int64_t stamp_ns = columns.front().stamp_ns;
    const std::int64_t end_ns = columns.back().stamp_ns + Model::kLayout.column_ns;
    const auto stamp = ruby128::write_ruby_timestamp(stamp_ns, kEncoding);
    if (stamp_ns >= next_difop_ns_) {
      next_difop_ns_ = stamp_ns + 1'000'000'000;
      difop_.stamp = stamp;
      const Status sent =
          write(ruby128::payload_of(difop_), end_ns, ruby128::kRubyDevicePort, capture);
      if (!sent) return sent;
    }
    std::array<std::uint8_t, robosense::kPacketBytes> bytes{};
    robosense::begin_packet(Model::kLayout, bytes);
    std::ranges::copy(stamp, bytes.begin() + robosense::kStampAt);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      fill(columns[c], std::span(bytes).subspan(robosense::block_at(static_cast<int>(c))));
    }
    return write(bytes, end_ns, ruby128::kRubyDataPort, capture);
  }

 private:
  static constexpr auto kEncoding = Model::kModel == sensor::SensorModel::kHelios
                                        ? ruby128::RubyTimestamp::kUtcMicroseconds
                                        : ruby128::RubyTimestamp::kCalendar;

  static void fill(const Column& column, std::span<std::uint8_t> block) noexcept {
    const auto put = [&](std::size_t at, std::uint16_t value) {
      std::ranges::copy(packet::Be16::of(value).bytes, block.subspan(at).begin());
    };
    put(robosense::kAzimuthAt,
        static_cast<std::uint16_t>(beams::wrap_cdeg(column.unwrapped_azimuth_cdeg)));
    std::size_t at = robosense::kReturnsAt;
    for (const LabelledReturn& beam : column.by_laser) {
      put(at, beam.raw);
      block[at + 2] = beam.intensity;
      at += 3;
    }
  }

  static Status write(std::span<const std::uint8_t> payload, std::int64_t stamp_ns,
                      std::uint16_t port, capture::PcapWriter& capture) {
    return capture.write({.payload = payload,
                          .stamp_ns = stamp_ns,
                          .source_address = 0xC0A801C8,       // 192.168.1.200
                          .destination_address = 0xC0A80166,  // 192.168.1.102
                          .source_port = port,
                          .destination_port = port});
  }

  ruby128::ruby128_wire::Difop difop_ = ruby128::blank_difop();
  std::int64_t next_difop_ns_ = 0;
};

}  // namespace terracut::packets
