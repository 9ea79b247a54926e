// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/hdl64e_sensor.hpp"

#include <algorithm>

namespace terracut::hdl64e {
namespace {

void read_s1_column(const wire::Block& block, const Hdl64eSensor::Returns& found) noexcept {
  constexpr std::size_t kBank = kLasersPerBlock;
  const std::size_t fired = block.id.value() == kUpperBlockId ? 0 : kBank;
  std::ranges::fill(found.raw.subspan(kBank - fired, kBank), std::uint16_t{0});
  packet::split_returns(&block.returns[0].distance.bytes[0], packet::ByteOrder::kLittle,
                        found.raw.subspan(fired, kBank), &found.intensity[fired]);
}

}  // namespace

Hdl64eSensor::Hdl64eSensor(const Calibration& calibration, const mount::Mount& mount,
                           const Config& config)
    : offsets_(calibration),
      kernel_(calibration, config.geometry, mount),
      metres_per_count_(static_cast<float>(calibration.distance_resolution_m)),
      rows_(mount::rows_upward(rows_by_elevation(calibration), mount)) {}

std::optional<frame::Reject> Hdl64eSensor::check(const packet::Datagram& datagram,
                                                 packet::PacketAzimuths& azimuths) noexcept {
  const auto* packet = packet_in(datagram.payload);
  if (packet == nullptr || !is_hdl64e_s1(*packet)) {
    return check_hdl64e_packet(datagram.payload, azimuths);
  }
  return s1_reader_.read(*packet, datagram.stamp_ns, azimuths);
}

void Hdl64eSensor::read_column(std::span<const std::uint8_t> payload, std::size_t column,
                               const Returns& found) const noexcept {
  const auto* packet = packet_in(payload);
  if (packet == nullptr) return;  // cannot happen: check() has accepted the packet
  if (is_s1_packet_) return read_s1_column(packet->blocks[column], found);
  for (std::size_t half = 0; half < 2; ++half) {
    const auto& returns = packet->blocks[2 * column + half].returns;
    const std::size_t first = half * kLasersPerBlock;
    packet::split_returns(&returns[0].distance.bytes[0], packet::ByteOrder::kLittle,
                          found.raw.subspan(first, returns.size()), &found.intensity[first]);
  }
}

}  // namespace terracut::hdl64e
