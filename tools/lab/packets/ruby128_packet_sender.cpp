// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/packets/ruby128_packet_sender.hpp"

#include "firmware_io/ruby128/difop_angles.hpp"
#include "firmware_io/ruby128/firing_azimuth.hpp"

namespace terracut::packets {
namespace {

/// Factory addresses (RS-Ruby manual).
constexpr std::array<std::uint8_t, 4> kSensor{192, 168, 1, 200};
constexpr std::array<std::uint8_t, 4> kHost{192, 168, 1, 102};
constexpr std::int64_t kDifopPeriod_ns = 1'000'000'000;

/// Return modes in DIFOP packets. All sources agree on the value for dual. The other value, used
/// here for single, was sent by a unit set to "strongest" (docs/reference/sensors.md).
constexpr std::uint8_t kStrongestMode = 1, kDualMode = 3;

constexpr std::uint32_t number_of(const std::array<std::uint8_t, 4>& address) {
  return std::uint32_t{address[0]} << 24 | std::uint32_t{address[1]} << 16 |
         std::uint32_t{address[2]} << 8 | std::uint32_t{address[3]};
}

packet::Datagram datagram(std::span<const std::uint8_t> payload, std::int64_t captured_ns,
                          std::uint16_t port) {
  return {.payload = payload,
          .stamp_ns = captured_ns,
          .source_address = number_of(kSensor),
          .destination_address = number_of(kHost),
          .source_port = port,
          .destination_port = port};
}

ruby128::ruby128_wire::Difop difop_of(const ruby128::Ruby128Calibration& calibration,
                                      const Ruby128Unit& unit, const Ruby128PacketFacts& facts) {
  ruby128::ruby128_wire::Difop difop = ruby128::blank_difop();
  difop.rpm_set = difop.rpm_actual = packet::Be16::of(unit.rpm);
  difop.device_address = kSensor;
  difop.destination_address = kHost;
  difop.mac = {0x02, 0x00, kSensor[0], kSensor[1], kSensor[2], kSensor[3]};  // as in the capture
  difop.data_port = ruby128::kRubyDataPort;
  difop.device_port = ruby128::kRubyDevicePort;
  difop.fov_end_cdeg = beams::kRevolution_cdeg;
  difop.serial = unit.serial;
  difop.return_mode = facts.returns == ReturnMode::kDual ? kDualMode : kStrongestMode;
  difop.temperatures.fill(
      packet::Be16::of(ruby128::ruby_temperature_field(unit.temperature_deg_c)));
  ruby128::set_calibration(difop, calibration);
  return difop;
}

}  // namespace

Ruby128PacketSender::Ruby128PacketSender(const ruby128::Ruby128Calibration& calibration,
                                         const Ruby128Unit& unit, Ruby128PacketFacts facts)
    : facts_(facts), difop_(difop_of(calibration, unit, facts)) {
  facts_.temperature_deg_c = unit.temperature_deg_c;
}

Status Ruby128PacketSender::send_difop(std::int64_t stamp_ns, std::int64_t captured_ns,
                                       capture::PcapWriter& capture) {
  difop_.stamp = ruby128::write_ruby_timestamp(stamp_ns, facts_.timestamp);
  return capture.write(
      datagram(ruby128::payload_of(difop_), captured_ns, ruby128::kRubyDevicePort));
}

Status Ruby128PacketSender::send(std::span<const Ruby128Column> columns, int first_column,
                                 capture::PcapWriter& capture) {
  const std::int64_t stamp_ns = columns.front().stamp_ns;
  const std::int64_t end_ns = columns.back().stamp_ns + ruby128::kRubyBlock_ns;
  if (!next_difop_ns_) next_difop_ns_ = stamp_ns;
  if (stamp_ns >= *next_difop_ns_) {
    if (Status sent = send_difop(stamp_ns, end_ns, capture); !sent) return sent;
    while (*next_difop_ns_ <= stamp_ns) *next_difop_ns_ += kDifopPeriod_ns;
  }
  encode_ruby128_packet(columns.first<ruby128::kRubyBlocksPerPacket>(), first_column, facts_,
                        packet_);
  return capture.write(datagram(ruby128::payload_of(packet_), end_ns, ruby128::kRubyDataPort));
}

}  // namespace terracut::packets
