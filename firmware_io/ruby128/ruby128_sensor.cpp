// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/ruby128_sensor.hpp"

#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/ruby128/packet_check.hpp"

namespace terracut::ruby128 {
namespace {

std::array<std::int32_t, kRubyBlocksPerPacket> block_azimuths(
    const packet::PacketAzimuths& azimuths) noexcept {
  return {azimuths.azimuth_cdeg[0], azimuths.azimuth_cdeg[1], azimuths.azimuth_cdeg[2]};
}

}  // namespace

Ruby128Sensor::Ruby128Sensor(const Calibration& calibration, const mount::Mount& mount,
                             const Config& config)
    : clock_(config.timestamp),
      offsets_(calibration),
      kernel_(calibration.channels, mount, kRuby128LensAhead_m),
      rows_(mount::rows_upward(rows_by_elevation(calibration), mount)) {}

std::optional<frame::Reject> Ruby128Sensor::check(const packet::Datagram& datagram,
                                                  packet::PacketAzimuths& azimuths) noexcept {
  const std::span<const std::uint8_t> payload = datagram.payload;
  auto reason = check_ruby128_packet(payload, azimuths);
  if (reason == frame::Reject::kAzimuthJump && read_across_sector(azimuths, step_ticks_))
    reason.reset();
  if (!reason) step_ticks_ = azimuths.step_ticks;
  const bool is_of_this_sensor = !reason || *reason == frame::Reject::kAzimuthOutOfRange ||
                                 *reason == frame::Reject::kAzimuthJump ||
                                 *reason == frame::Reject::kStationary;
  const auto* packet = packet_in(payload);
  if (!is_of_this_sensor || packet == nullptr) return reason;

  const std::int64_t stamp_ns = clock_.read(packet->stamp, azimuths);
  azimuths.device_stamp_us = ruby_even_stamp_us(stamp_ns, azimuths, !reason);
  return reason;
}

void Ruby128Sensor::begin_packet(const packet::PacketAzimuths& azimuths) noexcept {
  first_step_ticks_ = held_.join(block_azimuths(azimuths), azimuths.step_ticks,
                                 azimuths.device_stamp_us, azimuths.behind_sector > 0);
}

void Ruby128Sensor::read_column(std::span<const std::uint8_t> payload, std::size_t column,
                                const Returns& found) noexcept {
  const auto* packet = packet_in(payload);
  if (packet == nullptr) return;  // cannot happen: check() has accepted the packet
  packet::split_returns(&packet->blocks[column].returns[0].distance.bytes[0],
                        packet::ByteOrder::kBig, found.raw, &found.intensity[0]);
}

}  // namespace terracut::ruby128
