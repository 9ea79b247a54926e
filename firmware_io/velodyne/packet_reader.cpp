// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/velodyne/packet_reader.hpp"

#include "firmware_io/packet/sensor_recognition.hpp"

namespace terracut::velodyne {
namespace {

std::optional<frame::Reject> reject_model(std::span<const std::uint8_t> payload,
                                          sensor::SensorModel expected, bool is_named) noexcept {
  const sensor::SensorModel model =
      is_named ? sensor::recognise_sensor_as(expected, payload) : sensor::recognise_sensor(payload);
  if (model == expected) return std::nullopt;
  if (model == sensor::SensorModel::kVelodynePosition) return frame::Reject::kDeviceInfo;
  if (model != sensor::SensorModel::kUnknown) return frame::Reject::kWrongModel;
  return payload.size() == kPacketBytes ? frame::Reject::kWrongMagic : frame::Reject::kWrongSize;
}

}  // namespace

std::optional<frame::Reject> PacketReader::read(std::span<const std::uint8_t> payload,
                                                packet::PacketAzimuths& azimuths) noexcept {
  if (const auto reason = reject_model(payload, layout_.model, is_named_)) return reason;
  const auto* packet = hdl64e::packet_in(payload);
  if (packet == nullptr) return frame::Reject::kWrongSize;
  if (const auto reason = read_blocks(*packet, azimuths)) return reason;
  return steps_.judge(azimuths);
}

std::optional<frame::Reject> PacketReader::read_blocks(
    const hdl64e::wire::Packet& packet, packet::PacketAzimuths& azimuths) const noexcept {
  const std::optional<bool> mode = dual_return_of(packet);
  if (!mode) return frame::Reject::kWrongMagic;
  const bool dual_return = *mode;
  const int columns = layout_.columns(dual_return);
  bool ids_right = true, in_range = true, blocks_agree = true;
  for (int column = 0; column < columns; ++column) {
    std::int32_t& azimuth_cdeg = azimuths.azimuth_cdeg[static_cast<std::size_t>(column)];
    for (int part = 0; part < layout_.blocks_per_column; ++part) {
      const hdl64e::wire::Block& block = packet.blocks[layout_.block(column, part, dual_return)];
      const std::int32_t block_cdeg = block.azimuth_cdeg.value();
      if (part == 0) azimuth_cdeg = block_cdeg;
      ids_right &= block.id.value() == layout_.block_ids[static_cast<std::size_t>(part)];
      in_range &= block_cdeg < beams::kRevolution_cdeg;
      blocks_agree &= block_cdeg == azimuth_cdeg;
    }
    const bool is_second = dual_return && column % 2 == 1;
    blocks_agree &=
        !is_second || azimuth_cdeg == azimuths.azimuth_cdeg[static_cast<std::size_t>(column - 1)];
  }
  if (!ids_right) return frame::Reject::kWrongMagic;
  azimuths.columns = columns;
  azimuths.behind_sector = 0;
  azimuths.dual_return = dual_return;
  azimuths.device_stamp_us = packet.stamp_us.value() % kClockWrap_us;
  if (!in_range) return frame::Reject::kAzimuthOutOfRange;
  return blocks_agree ? std::nullopt : std::optional(frame::Reject::kAzimuthMismatch);
}

std::optional<bool> PacketReader::dual_return_of(
    const hdl64e::wire::Packet& packet) const noexcept {
  const std::uint8_t mode = packet.status_type;
  if (mode == kStrongest || mode == kLast || mode == kDual) return mode == kDual;
  const bool is_known = sensor::recognise_sensor(hdl64e::payload_of(packet)) == layout_.model;
  if (!is_named_ || is_known) return std::nullopt;
  const auto azimuth = [&](std::size_t block) { return packet.blocks[block].azimuth_cdeg.value(); };
  bool are_pairs = true;
  for (std::size_t block = 0; block < packet.blocks.size(); block += 2) {
    are_pairs &= azimuth(block) == azimuth(block + 1);
  }
  return are_pairs;
}

}  // namespace terracut::velodyne
