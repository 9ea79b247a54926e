// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/tables/status_stream_writer.hpp"

#include <algorithm>
#include <chrono>

namespace terracut::tables {
namespace {

std::array<std::uint8_t, 6> time_bytes_of(std::int64_t stamp_ns) noexcept {
  using namespace std::chrono;
  const sys_seconds time{floor<seconds>(nanoseconds{stamp_ns})};
  const sys_days midnight = floor<days>(time);
  const year_month_day date{midnight};
  const hh_mm_ss clock{time - midnight};
  const auto byte = [](auto value) { return static_cast<std::uint8_t>(value); };
  return {byte(clock.hours().count()),
          byte(clock.minutes().count()),
          byte(clock.seconds().count()),
          byte(static_cast<unsigned>(date.day())),
          byte(static_cast<unsigned>(date.month())),
          byte(static_cast<int>(date.year()) - 2000)};
}

/// Returns the type byte of a table byte; types other than digits are in the HDL-64E S3 manual Rev
/// K, pp. 36-38.
std::uint8_t table_type(hdl64e::StatusFlavour flavour, std::size_t group,
                        std::size_t place) noexcept {
  constexpr std::size_t kFirstTailGroup = 256;
  if (flavour == hdl64e::StatusFlavour::kS3) {
    if (place == 0 && group % 4 == 0 && group > 0 && group < kFirstTailGroup)
      return hdl64e::kWarningType;
    constexpr std::array<std::uint8_t, 6> kMotorAndView{0xFE, 0xFF, 0xFC, 0xFD, 0xFA, 0xFB};
    if (group == 257 && place < kMotorAndView.size()) return kMotorAndView[place];
    if (group == 259 && place == 2) return 0xF9;  // return setting
    if (group == 259 && place == 4) return 0xF8;  // power level
  }
  return static_cast<std::uint8_t>('1' + place);
}

}  // namespace

StatusStreamWriter::StatusStreamWriter(
    std::span<const std::uint8_t, hdl64e::kStreamTableBytes> table, hdl64e::StatusFlavour flavour,
    StatusValues values) noexcept
    : flavour_(flavour), values_(values) {
  std::copy(table.begin(), table.end(), table_.begin());
}

hdl64e::StatusPair StatusStreamWriter::next(std::int64_t stamp_ns) noexcept {
  const std::uint32_t place = packet_ % hdl64e::kStatusCyclePackets;
  const std::size_t group = packet_ / hdl64e::kStatusCyclePackets;
  packet_ = (packet_ + 1) % hdl64e::kStatusRoundPackets;
  if (place == 0) time_ = time_bytes_of(stamp_ns);
  if (place >= hdl64e::kFirstTablePlace) return table_pair(group, place - hdl64e::kFirstTablePlace);

  const std::array<std::uint8_t, 3> state{
      values_.gps, static_cast<std::uint8_t>(values_.temperature_deg_c), values_.firmware};
  return {static_cast<std::uint8_t>(hdl64e::kStatusLetters[place]),
          place < time_.size() ? time_[place] : state[place - time_.size()]};
}

hdl64e::StatusPair StatusStreamWriter::table_pair(std::size_t group,
                                                  std::size_t place) const noexcept {
  return {table_type(flavour_, group, place), table_[group * hdl64e::kTableBytesPerCycle + place]};
}

}  // namespace terracut::tables
