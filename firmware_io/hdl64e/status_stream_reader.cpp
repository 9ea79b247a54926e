// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/status_stream_reader.hpp"

#include <chrono>

namespace terracut::hdl64e {
namespace {

constexpr int kTimePlaces = 6;  // H M S D N Y
constexpr int kGpsPlace = 6;
constexpr int kTemperaturePlace = 7;
constexpr int kFirmwarePlace = 8;
constexpr std::size_t kS2WarningAt = 1816;  // group 259, after the return setting

bool is_date_time(const DateTime& time) noexcept {
  using namespace std::chrono;
  const year_month_day date{year{time.year}, month{static_cast<unsigned>(time.month)},
                            day{static_cast<unsigned>(time.day)}};
  return date.ok() && time.hour < 24 && time.minute < 60 && time.second <= 60;
}

}  // namespace

void StatusStreamReader::add(std::uint8_t type, std::uint8_t value,
                             std::uint32_t device_stamp_us) noexcept {
  ++counters_.packets;
  const std::optional<int> place = status_place(type);
  const auto located = position_.locate(place, device_stamp_us);
  if (!located) {
    ++counters_.unplaced;
    return;
  }
  if (located->restarted) begin_anew();

  const std::int64_t cycle = located->packet / kStatusCyclePackets;
  const auto cycle_place = static_cast<int>(located->packet % kStatusCyclePackets);
  for (; newest_cycle_ < cycle; ++newest_cycle_) {
    if (collector_.starts_round(newest_cycle_ + 1)) {
      ++counters_.rounds;
      try_accept();
    }
  }
  if (cycle_place < kFirstTablePlace) {
    read_letter(cycle, cycle_place, value, device_stamp_us);
    return;
  }
  if (type == kWarningType) {
    warning_type_seen_ = true;
    latest_.warning_bits = value;
    latest_.flavour = StatusFlavour::kS3;
  }
  read_table_byte(cycle, cycle_place - kFirstTablePlace, value);
}

void StatusStreamReader::begin_anew() noexcept {
  if (counters_.packets > 1) ++counters_.restarts;
  collector_.clear();
  warning_type_seen_ = false;
  newest_cycle_ = 0;
  time_cycle_ = -1;
}

void StatusStreamReader::read_letter(std::int64_t cycle, int place, std::uint8_t value,
                                     std::uint32_t stamp_us) noexcept {
  if (place == kGpsPlace) latest_.gps = static_cast<GpsState>(value);
  if (place == kTemperaturePlace) latest_.temperature_deg_c = static_cast<std::int8_t>(value);
  if (place == kFirmwarePlace) latest_.firmware = value;
  if (place >= kTimePlaces || cycle < time_cycle_) return;

  if (cycle != time_cycle_) {
    time_cycle_ = cycle;
    time_places_ = 0;
  }
  if (place == 0) time_stamp_us_ = stamp_us;
  time_bytes_[static_cast<std::size_t>(place)] = value;
  time_places_ |= 1U << place;
  if (time_places_ != (1U << kTimePlaces) - 1) return;
  const DateTime time{.year = 2000 + time_bytes_[5],
                      .month = time_bytes_[4],
                      .day = time_bytes_[3],
                      .hour = time_bytes_[0],
                      .minute = time_bytes_[1],
                      .second = time_bytes_[2]};
  if (is_date_time(time)) {
    latest_.time = time;
    latest_.time_stamp_us = time_stamp_us_;
  }
}

void StatusStreamReader::read_table_byte(std::int64_t cycle, int place,
                                         std::uint8_t value) noexcept {
  const std::size_t holes_before = collector_.holes();
  collector_.add(cycle, place, value);
  const bool filled_last_hole = holes_before != 0 && collector_.holes() == 0;
  const bool ends_round = place == kTableBytesPerCycle - 1 && collector_.starts_round(cycle + 1);
  if (filled_last_hole || ends_round) try_accept();
}

void StatusStreamReader::try_accept() noexcept {
  const std::uint32_t generation_before = collector_.generation();
  switch (collector_.try_accept(warning_type_seen_)) {
    case StatusTableCollector::Refusal::kCrc:
      ++counters_.refused_by_crc;
      break;
    case StatusTableCollector::Refusal::kLaserNumbers:
      ++counters_.refused_by_laser_numbers;
      break;
    case StatusTableCollector::Refusal::kNone:
      break;
  }
  if (collector_.accepted() && !warning_type_seen_ &&
      (!latest_.flavour || collector_.generation() != generation_before)) {
    latest_.flavour = StatusFlavour::kS2;
  }
  if (latest_.flavour == StatusFlavour::kS2)
    latest_.warning_bits = collector_.table()[kS2WarningAt];
}

}  // namespace terracut::hdl64e
