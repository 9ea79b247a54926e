// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/packets/hdl64e_packet_sender.hpp"

#include "calib/hdl64e/hdl64e_stream_table.hpp"
#include "tools/lab/packets/hdl64e_packet_encoder.hpp"

namespace terracut::packets {
namespace {

/// Factory addresses of the sensor and its broadcast (HDL-64E S3 manual).
constexpr std::uint32_t kSensorAddress = 0xC0A8032B;     // 192.168.3.43
constexpr std::uint32_t kBroadcastAddress = 0xC0A803FF;  // 192.168.3.255

}  // namespace

Expected<Hdl64ePacketSender> Hdl64ePacketSender::create(
    const hdl64e::Hdl64eCalibration& calibration, ReturnMode returns) {
  const bool both = returns == ReturnMode::kDual;
  const auto table = hdl64e::make_stream_table(
      calibration, both ? hdl64e::ReturnSetting::kBoth : hdl64e::ReturnSetting::kStrongest);
  if (!table) return tl::unexpected(table.error());
  return Hdl64ePacketSender(tables::StatusStreamWriter(*table, hdl64e::StatusFlavour::kS3));
}

Status Hdl64ePacketSender::send(std::span<const FiringColumn> columns, int,
                                capture::PcapWriter& capture) {
  const auto whole = columns.first<hdl64e::kColumnsPerPacketSingle>();
  const std::int64_t end_ns = packet_end_ns(whole);
  encode_hdl64e_packet(whole, end_ns, status_.next(end_ns), packet_);
  return capture.write({.payload = hdl64e::payload_of(packet_),
                        .stamp_ns = end_ns,
                        .source_address = kSensorAddress,
                        .destination_address = kBroadcastAddress,
                        .source_port = hdl64e::kHdl64eSourcePort,
                        .destination_port = hdl64e::kHdl64eDataPort});
}

}  // namespace terracut::packets
