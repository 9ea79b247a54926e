// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "ruby128_reference.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace terracut::reference {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kColumn_us = 55.55;
constexpr double kGroup_us = 3.236;
constexpr double kLensAhead_m = 0.03615;
constexpr RotorLimits kLimits{
    .forwards_cdeg = 100, .backwards_cdeg = 2, .least_sweep_cdeg = 4, .standing_back_cdeg = 4};

std::int64_t big_endian(std::span<const std::uint8_t> payload, std::size_t at, std::size_t bytes) {
  std::int64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) value = value * 256 + payload[at + i];
  return value;
}

Refusal read_azimuths(std::span<const std::uint8_t> payload, int (&block_cdeg)[3]) {
  if (payload.size() != 1248) return Refusal::kOtherPacket;
  if (big_endian(payload, 0, 4) != 0x55AA055A) return Refusal::kOtherPacket;
  for (std::size_t block = 0; block < 3; ++block) {
    if (payload[80 + 388 * block] != 0xFE) return Refusal::kOtherPacket;
  }
  // A Ruby Plus has the same layout, but other angles and times.
  if (payload[31] == 5 && payload[32] == 1) return Refusal::kOtherPacket;
  for (std::size_t block = 0; block < 3; ++block) {
    block_cdeg[block] = static_cast<int>(big_endian(payload, 80 + 388 * block + 2, 2));
  }
  for (const int cdeg : block_cdeg) {
    if (cdeg > 35'999) return Refusal::kAzimuthRange;
  }
  return Refusal::kNone;
}

bool leap(std::int64_t year) {
  return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

int days_of_month(std::int64_t year, std::int64_t month) {
  if (month == 2) return leap(year) ? 29 : 28;
  return month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

std::optional<std::int64_t> seconds_and_parts_ns(std::span<const std::uint8_t> payload,
                                                 std::int64_t parts_per_second) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const std::int64_t seconds = big_endian(payload, 10, 6);
  const std::int64_t parts = big_endian(payload, 16, 4);
  // Up to the year 2262 nanoseconds since 1970 are a 64-bit number.
  if (parts >= parts_per_second || seconds >= INT64_MAX / kSecond_ns) return std::nullopt;
  return seconds * kSecond_ns + parts * (kSecond_ns / parts_per_second);
}

}  // namespace

Packet Ruby128Reference::decode(std::span<const std::uint8_t> payload) {
  Packet packet;
  int block_cdeg[3] = {};
  packet.refusal = read_azimuths(payload, block_cdeg);
  if (packet.refusal != Refusal::kNone) return packet;
  packet.refusal = judge_rotation(block_cdeg, kLimits);
  if (packet.refusal != Refusal::kNone) return packet;

  // In dual return A A B or A B B: the lone one has its partner in the packet before or after.
  packet.columns = 3;
  packet.first_deg = block_cdeg[0] / 100.0;
  const bool pair_first = block_cdeg[0] == block_cdeg[1];
  const bool pair_last = !pair_first && block_cdeg[1] == block_cdeg[2];
  packet.dual_return = pair_first || pair_last;
  const double advance_deg = clockwise_cdeg(block_cdeg[0], block_cdeg[2]) / 100.0;
  packet.step_deg = packet.dual_return ? advance_deg : advance_deg / 2;
  const bool second_of_pending = pair_last && pending_step_deg_ && pending_cdeg_ == block_cdeg[0];
  const double firing_of_block[3] = {0.0, pair_first ? 0.0 : 1.0, packet.dual_return ? 1.0 : 2.0};
  for (int block = 0; block < 3; ++block) {
    const double step_deg = block == 0 && second_of_pending ? *pending_step_deg_ : packet.step_deg;
    const double block_deg =
        packet.first_deg + clockwise_cdeg(block_cdeg[0], block_cdeg[block]) / 100.0;
    for (int channel = 0; channel < 128; ++channel) {
      const auto at = static_cast<std::size_t>(80 + 388 * block + 4 + 3 * channel);
      Return beam;
      beam.column = block;
      beam.laser = channel;
      beam.raw_distance = static_cast<int>(big_endian(payload, at, 2));
      beam.intensity = payload[at + 2];
      if (beam.raw_distance == 0) continue;
      const double in_column_us = kGroup_us * (channel / 4 % 16);
      beam.fired_us = kColumn_us * firing_of_block[block] + in_column_us;
      beam.rotor_deg = block_deg + step_deg * in_column_us / kColumn_us;
      locate(beam);
      packet.returns.push_back(beam);
    }
  }
  reset();
  if (pair_first) {
    pending_cdeg_ = block_cdeg[2];
    pending_step_deg_ = packet.step_deg;
  }
  return packet;
}

void Ruby128Reference::locate(Return& beam) const {
  const ruby128::Ruby128Channel& channel =
      calibration_.channels[static_cast<std::size_t>(beam.laser)];
  const double v = channel.elevation_rad, h = channel.azimuth_offset_rad;
  const double head = beam.rotor_deg * kRadPerDeg;
  const double d = beam.raw_distance * 0.005;
  beam.beam_deg = beam.rotor_deg + h / kRadPerDeg;
  beam.x_m = d * std::cos(v) * std::cos(head + h) + kLensAhead_m * std::cos(head);
  beam.y_m = -d * std::cos(v) * std::sin(head + h) - kLensAhead_m * std::sin(head);
  beam.z_m = d * std::sin(v);
}

double ruby128_temperature_c(std::span<const std::uint8_t> payload) {
  const int magnitude = (payload[8] & 0x7F) * 16 + payload[9] / 16;
  return (payload[8] >= 0x80 ? -magnitude : magnitude) * 0.0625;
}

std::optional<std::int64_t> ruby128_calendar_ns(std::span<const std::uint8_t> payload) {
  const std::int64_t year = 2000 + payload[10], month = payload[11], day = payload[12];
  const std::int64_t hour = payload[13], minute = payload[14], second = payload[15];
  const std::int64_t millisecond = big_endian(payload, 16, 2);
  const std::int64_t microsecond = big_endian(payload, 18, 2);
  if (month < 1 || month > 12 || day < 1 || day > days_of_month(year, month) || hour > 23 ||
      minute > 59 || second > 59 || millisecond > 999 || microsecond > 999) {
    return std::nullopt;
  }
  std::int64_t days = day - 1;
  for (std::int64_t y = 1970; y < year; ++y) days += leap(y) ? 366 : 365;
  for (std::int64_t m = 1; m < month; ++m) days += days_of_month(year, m);
  const std::int64_t seconds = ((days * 24 + hour) * 60 + minute) * 60 + second;
  return (seconds * 1'000'000 + millisecond * 1'000 + microsecond) * 1'000;
}

std::optional<std::int64_t> ruby128_microseconds_ns(std::span<const std::uint8_t> payload) {
  return seconds_and_parts_ns(payload, 1'000'000);
}

std::optional<std::int64_t> ruby128_nanoseconds_ns(std::span<const std::uint8_t> payload) {
  return seconds_and_parts_ns(payload, 1'000'000'000);
}

}  // namespace terracut::reference
