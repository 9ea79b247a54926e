// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/packet_sender.hpp"

#include "calib/hdl64e_stream_table.hpp"
#include "firmware_io/hdl64e/packet_encoder.hpp"

namespace terracut::firmware_io {
namespace {

/// Factory addresses of the sensor and its broadcast (HDL-64E S3 manual).
constexpr std::uint32_t kSensorAddress = 0xC0A8032B;     // 192.168.3.43
constexpr std::uint32_t kBroadcastAddress = 0xC0A803FF;  // 192.168.3.255

}  // namespace

Expected<Hdl64ePacketSender> Hdl64ePacketSender::create(const calib::Hdl64eCalibration& calibration,
                                                        ReturnMode returns) {
  calib::UnitInfo unit;
  if (returns == ReturnMode::kDual) {
    unit.return_setting = static_cast<std::uint8_t>(calib::ReturnSetting::kBoth);
  }
  const auto table = calib::make_stream_table(calibration, unit);
  if (!table) return tl::unexpected(table.error());
  return Hdl64ePacketSender(StatusStreamWriter(*table, StatusFlavour::kS3));
}

Status Hdl64ePacketSender::send(std::span<const FiringColumn, kColumnsPerPacketSingle> columns, int,
                                PcapWriter& capture) {
  const std::int64_t end_ns = packet_end_ns(columns);
  encode_hdl64e_packet(columns, end_ns, status_.next(end_ns), packet_);
  return capture.write({.payload = packet_.payload(),
                        .stamp_ns = end_ns,
                        .source_address = kSensorAddress,
                        .destination_address = kBroadcastAddress,
                        .source_port = kHdl64eSourcePort,
                        .destination_port = kHdl64eDataPort});
}

}  // namespace terracut::firmware_io
