// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/robosense/packet_reader.hpp"

#include <cstddef>

#include "calib/beams/angle.hpp"
#include "firmware_io/packet/sensor_recognition.hpp"

namespace terracut::robosense {
namespace {

std::optional<frame::Reject> reject_model(const PacketLayout& layout,
                                          std::span<const std::uint8_t> payload) noexcept {
  const sensor::SensorModel model = sensor::recognise_sensor_as(layout.model, payload);
  if (model == layout.model) return std::nullopt;
  if (model == sensor::SensorModel::kRoboSenseDeviceInfo) return frame::Reject::kDeviceInfo;
  if (model != sensor::SensorModel::kUnknown && model != sensor::SensorModel::kOtherRoboSense) {
    return frame::Reject::kWrongModel;
  }
  return payload.size() == kPacketBytes ? frame::Reject::kWrongMagic : frame::Reject::kWrongSize;
}

}  // namespace

std::optional<frame::Reject> PacketReader::read(std::span<const std::uint8_t> payload,
                                                packet::PacketAzimuths& azimuths) noexcept {
  if (const auto reason = reject_model(layout_, payload)) return reason;
  azimuths.columns = kBlocks;
  azimuths.behind_sector = 0;
  bool in_range = true, are_pairs = true;
  for (int block = 0; block < kBlocks; ++block) {
    const auto b = static_cast<std::size_t>(block);
    const std::size_t at = block_at(block) + kAzimuthAt;
    azimuths.azimuth_cdeg[b] = payload[at] << 8 | payload[at + 1];
    in_range &= azimuths.azimuth_cdeg[b] < beams::kRevolution_cdeg;
    are_pairs &= block % 2 == 0 || azimuths.azimuth_cdeg[b] == azimuths.azimuth_cdeg[b - 1];
  }
  azimuths.dual_return = are_pairs;
  clock_.read(payload.subspan<kStampAt, kStampBytes>(), azimuths);
  if (!in_range) return frame::Reject::kAzimuthOutOfRange;
  return steps_.judge(azimuths);
}

}  // namespace terracut::robosense
