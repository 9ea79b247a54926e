// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hesai/packet_reader.hpp"

#include <algorithm>
#include <cstddef>

#include "calib/beams/angle.hpp"
#include "firmware_io/packet/sensor_recognition.hpp"

namespace terracut::hesai {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint32_t little_endian(Bytes bytes) noexcept {
  std::uint32_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | bytes[i];
  return value;
}

/// Returns the days of a date since a day before the calendar's year 0. Any bytes give a
/// number >= 0, and later dates give larger ones; years divisible by 4 are leap years, as they are
/// in [1901, 2099].
constexpr std::int64_t days_of(std::int64_t year, std::int64_t month, std::int64_t day) noexcept {
  const std::int64_t from_march = (month + 9) % 12;
  const std::int64_t years = year + 4 - (month < 3 ? 1 : 0);
  return years * 365 + years / 4 + (153 * from_march + 2) / 5 + day;
}

/// Returns the tail's time: year, month, day, hour, minute and second, a byte each, and the
/// microseconds of the second.
std::int64_t stamp_us(Bytes date, std::uint32_t us) noexcept {
  const std::int64_t hours = days_of(date[0], date[1], date[2]) * 24 + date[3];
  return ((hours * 60 + date[4]) * 60 + date[5]) * 1'000'000 + us;
}

std::optional<bool> is_dual(std::uint8_t mode) noexcept {
  if (std::ranges::find(kDualModes, mode) != kDualModes.end()) return true;
  return std::ranges::find(kSingleModes, mode) != kSingleModes.end() ? std::optional(false)
                                                                     : std::nullopt;
}

}  // namespace

std::optional<frame::Reject> PacketReader::read(Bytes payload,
                                                packet::PacketAzimuths& azimuths) noexcept {
  if (!is_of(layout_, payload)) {
    if (sensor::recognise_sensor(payload) != sensor::SensorModel::kUnknown) {
      return frame::Reject::kWrongModel;
    }
    return layout_.fits(payload.size()) ? frame::Reject::kWrongMagic : frame::Reject::kWrongSize;
  }
  // Where blocks begin to follow one another at another rate, steps are judged anew.
  if (const std::int32_t column_ns = layout_of(layout_.model).column_ns_in(payload);
      column_ns != layout_.column_ns) {
    layout_.column_ns = column_ns;
    steps_ = table::HeadSteps(pace_of(layout_), kClockWrap_us);
  }
  const Bytes tail = payload.subspan(layout_.tail_at());
  const std::optional<bool> dual_return = is_dual(tail[layout_.tail.return_mode_at]);
  if (!dual_return) return frame::Reject::kWrongMagic;
  azimuths.columns = layout_.blocks;
  azimuths.behind_sector = 0;
  azimuths.dual_return = *dual_return;
  azimuths.device_stamp_us = stamp_us(tail.subspan(layout_.tail.date_at, 6),
                                      little_endian(tail.subspan(layout_.tail.stamp_us_at, 4)));
  bool in_range = true, pairs_agree = true;
  for (int block = 0; block < layout_.blocks; ++block) {
    const auto b = static_cast<std::size_t>(block);
    azimuths.azimuth_cdeg[b] = static_cast<std::int32_t>(
        little_endian(payload.subspan(layout_.block_at(block) + layout_.azimuth_at(), 2)));
    in_range &= azimuths.azimuth_cdeg[b] < beams::kRevolution_cdeg;
    const bool is_second = *dual_return && block % 2 == 1;
    pairs_agree &= !is_second || azimuths.azimuth_cdeg[b] == azimuths.azimuth_cdeg[b - 1];
  }
  if (!in_range) return frame::Reject::kAzimuthOutOfRange;
  if (!pairs_agree) return frame::Reject::kAzimuthMismatch;
  return steps_.judge(azimuths);
}

}  // namespace terracut::hesai
