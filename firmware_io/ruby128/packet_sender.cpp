// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/packet_sender.hpp"

#include "firmware_io/ruby128/device_info.hpp"
#include "firmware_io/ruby128/difop_angles.hpp"
#include "firmware_io/ruby128/firing_azimuth.hpp"

namespace terracut::firmware_io {
namespace {

/// Factory addresses (RS-Ruby manual).
constexpr std::array<std::uint8_t, 4> kSensor{192, 168, 1, 200};
constexpr std::array<std::uint8_t, 4> kHost{192, 168, 1, 102};
constexpr std::int64_t kDifopPeriod_ns = 1'000'000'000;

/// Return modes of the DIFOP. All sources agree on dual; single is what a unit set to "strongest"
/// was seen to send (docs/sensors.md).
constexpr std::uint8_t kStrongestMode = 1, kDualMode = 3;

constexpr std::uint32_t number_of(const std::array<std::uint8_t, 4>& address) {
  return std::uint32_t{address[0]} << 24 | std::uint32_t{address[1]} << 16 |
         std::uint32_t{address[2]} << 8 | std::uint32_t{address[3]};
}

Datagram datagram(std::span<const std::uint8_t> payload, std::int64_t captured_ns,
                  std::uint16_t port) {
  return {.payload = payload,
          .stamp_ns = captured_ns,
          .source_address = number_of(kSensor),
          .destination_address = number_of(kHost),
          .source_port = port,
          .destination_port = port};
}

ruby128_wire::Difop difop_of(const calib::Ruby128Calibration& calibration, const Ruby128Unit& unit,
                             const Ruby128PacketFacts& facts) {
  Ruby128DeviceInfo info;
  info.rpm_set = info.rpm_actual = unit.rpm;
  info.device_address = kSensor;
  info.destination_address = kHost;
  info.mac = {0x02, 0x00, kSensor[0], kSensor[1], kSensor[2], kSensor[3]};  // as in the capture
  info.data_port = kRubyDataPort;
  info.device_port = kRubyDevicePort;
  info.fov_end_cdeg = calib::kTurn_cdeg;
  info.serial = unit.serial;
  info.return_mode_raw = facts.returns == ReturnMode::kDual ? kDualMode : kStrongestMode;
  info.temperatures_raw.fill(ruby_temperature_field(unit.temperature_deg_c));
  ruby128_wire::Difop difop = blank_difop();
  set_device_info(difop, info);
  set_calibration(difop, calibration);
  return difop;
}

}  // namespace

Ruby128PacketSender::Ruby128PacketSender(const calib::Ruby128Calibration& calibration,
                                         const Ruby128Unit& unit, Ruby128PacketFacts facts)
    : facts_(facts), difop_(difop_of(calibration, unit, facts)) {
  facts_.temperature_deg_c = unit.temperature_deg_c;
}

Status Ruby128PacketSender::send_difop(std::int64_t stamp_ns, std::int64_t captured_ns,
                                       PcapWriter& capture) {
  difop_.stamp = write_ruby_timestamp(stamp_ns, facts_.timestamp);
  return capture.write(datagram(payload_of(difop_), captured_ns, kRubyDevicePort));
}

Status Ruby128PacketSender::send(std::span<const Ruby128Column, kRubyBlocksPerPacket> columns,
                                 int first_column, PcapWriter& capture) {
  const std::int64_t stamp_ns = columns.front().stamp_ns;
  const std::int64_t end_ns = columns.back().stamp_ns + kRubyBlock_ns;
  if (!next_difop_ns_) next_difop_ns_ = stamp_ns;
  if (stamp_ns >= *next_difop_ns_) {
    if (Status sent = send_difop(stamp_ns, end_ns, capture); !sent) return sent;
    while (*next_difop_ns_ <= stamp_ns) *next_difop_ns_ += kDifopPeriod_ns;
  }
  encode_ruby128_packet(columns, first_column, facts_, packet_);
  return capture.write(datagram(packet_.payload(), end_ns, kRubyDataPort));
}

}  // namespace terracut::firmware_io
