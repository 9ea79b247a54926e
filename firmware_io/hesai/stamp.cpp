// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hesai/stamp.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include "firmware_io/packet/wire_integer.hpp"

namespace terracut::hesai {

std::int64_t read_stamp_us(const PacketLayout& layout, std::span<const std::uint8_t> payload) {
  using namespace std::chrono;
  const auto tail = payload.subspan(layout.tail_at());
  const auto date = tail.subspan(layout.tail.date_at, 6);
  packet::Le32 us{};
  std::ranges::copy(tail.subspan(layout.tail.stamp_us_at, us.bytes.size()), us.bytes.begin());
  const sys_days day = year(layout.tail.first_year + date[0]) / month(date[1]) / int{date[2]};
  const auto second = day + hours(date[3]) + minutes(date[4]) + seconds(date[5]);
  return (second.time_since_epoch() + microseconds(us.value())).count();
}

void write_stamp_us(const PacketLayout& layout, std::int64_t stamp_us,
                    std::span<std::uint8_t> payload) {
  using namespace std::chrono;
  const sys_time<microseconds> time{microseconds(stamp_us)};
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  const auto tail = payload.subspan(layout.tail_at());
  const std::array<std::uint8_t, 6> bytes{
      static_cast<std::uint8_t>(static_cast<int>(date.year()) - layout.tail.first_year),
      static_cast<std::uint8_t>(static_cast<unsigned>(date.month())),
      static_cast<std::uint8_t>(static_cast<unsigned>(date.day())),
      static_cast<std::uint8_t>(clock.hours().count()),
      static_cast<std::uint8_t>(clock.minutes().count()),
      static_cast<std::uint8_t>(clock.seconds().count())};
  std::ranges::copy(bytes, tail.subspan(layout.tail.date_at).begin());
  const auto us = packet::Le32::of(static_cast<std::uint32_t>(clock.subseconds().count()));
  std::ranges::copy(us.bytes, tail.subspan(layout.tail.stamp_us_at).begin());
}

}  // namespace terracut::hesai
