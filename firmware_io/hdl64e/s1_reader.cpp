// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/s1_reader.hpp"

#include <utility>

namespace terracut::hdl64e {
namespace {

constexpr std::int64_t kMostPaces = 256;
/// Longer outages (more than a day) are not counted as lost packets.
constexpr std::int64_t kLongestOutage_ns = 86'400'000'000'000;

constexpr std::int64_t rounded(std::int64_t value, std::int64_t unit) noexcept {
  return (value >= 0 ? value + unit / 2 : value - unit / 2) / unit;
}

/// Returns the made-up device stamp of packet number `packet`.
constexpr std::int64_t stamp_us(std::int64_t packet) noexcept {
  constexpr std::int64_t kHour_us = kDeviceHour_us;
  const std::int64_t in_hour_us = packet * kS1Packet_ns / 1000 % kHour_us;
  return in_hour_us < 0 ? in_hour_us + kHour_us : in_hour_us;
}

}  // namespace

std::int64_t S1Reader::mean_pace(std::int32_t pace_ticks) noexcept {
  paces_ticks_ += pace_ticks;
  if (++paces_ == kMostPaces) {
    paces_ticks_ /= 2;
    paces_ /= 2;
  }
  return paces_ticks_ / paces_;
}

std::int64_t S1Reader::missing_revolutions(std::int64_t rotated_ticks, std::int64_t pace_ticks,
                                           std::int64_t host_ns) const noexcept {
  // The difference wraps instead of overflowing, because the stamps of a capture may be anything.
  const auto since_ns = static_cast<std::int64_t>(static_cast<std::uint64_t>(host_ns) -
                                                  static_cast<std::uint64_t>(host_ns_));
  if (since_ns <= 0 || since_ns > kLongestOutage_ns) return 0;
  const std::int64_t revolution_ns =
      std::int64_t{kS1Packet_ns} * packet::kRevolution_ticks / pace_ticks;
  const std::int64_t rotated_ns = rotated_ticks * kS1Packet_ns / pace_ticks;
  return since_ns > rotated_ns ? rounded(since_ns - rotated_ns, revolution_ns) : 0;
}

std::int64_t S1Reader::number_of(const packet::PacketAzimuths& azimuths,
                                 std::int64_t host_ns) noexcept {
  const std::int64_t pace_ticks = mean_pace(azimuths.pace_ticks);
  if (!std::exchange(has_begun_, true)) return packet_;
  const std::int64_t rotated_ticks =
      std::int64_t{beams::step_cdeg(azimuth_cdeg_, azimuths.first_cdeg())} * packet::kTicksPerCdeg;
  const std::int64_t revolutions = missing_revolutions(rotated_ticks, pace_ticks, host_ns);
  return packet_ + rounded(rotated_ticks + revolutions * packet::kRevolution_ticks, pace_ticks);
}

std::optional<frame::Reject> S1Reader::read(const wire::Packet& packet, std::int64_t host_ns,
                                            packet::PacketAzimuths& azimuths) noexcept {
  const auto reason = check_hdl64e_s1_packet(packet, azimuths);
  const bool is_standing = reason == frame::Reject::kStationary;
  const std::int64_t number = reason ? packet_ + 1 : number_of(azimuths, host_ns);
  azimuths.device_stamp_us = stamp_us(number);
  if (!reason || is_standing) take(number, azimuths.first_cdeg(), host_ns);
  return reason;
}

}  // namespace terracut::hdl64e
