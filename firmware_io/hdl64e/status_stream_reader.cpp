// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/status_stream_reader.hpp"

namespace terracut::hdl64e {
namespace {

constexpr int kTemperaturePlace = 7;
constexpr int kFirmwarePlace = 8;
constexpr std::size_t kS2WarningAt = 1816;  // group 259, after the return setting

}  // namespace

void StatusStreamReader::add(std::uint8_t type, std::uint8_t value,
                             std::uint32_t device_stamp_us) noexcept {
  const std::optional<int> place = status_place(type);
  const auto located = position_.locate(place, device_stamp_us);
  if (!located) return;
  if (located->restarted) begin_anew();

  const std::int64_t cycle = located->packet / kStatusCyclePackets;
  const auto cycle_place = static_cast<int>(located->packet % kStatusCyclePackets);
  for (; newest_cycle_ < cycle; ++newest_cycle_) {
    if (collector_.starts_round(newest_cycle_ + 1)) try_accept();
  }
  if (cycle_place < kFirstTablePlace) {
    if (cycle_place == kTemperaturePlace) {
      latest_.temperature_deg_c = static_cast<std::int8_t>(value);
    }
    if (cycle_place == kFirmwarePlace) latest_.firmware = value;
    return;
  }
  if (type == kWarningType) {
    warning_type_seen_ = true;
    latest_.warning_bits = value;
    flavour_ = StatusFlavour::kS3;
  }
  read_table_byte(cycle, cycle_place - kFirstTablePlace, value);
}

void StatusStreamReader::begin_anew() noexcept {
  collector_.clear();
  warning_type_seen_ = false;
  newest_cycle_ = 0;
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
  collector_.try_accept(warning_type_seen_);
  if (collector_.accepted() && !warning_type_seen_ &&
      (!flavour_ || collector_.generation() != generation_before)) {
    flavour_ = StatusFlavour::kS2;
  }
  if (flavour_ == StatusFlavour::kS2) latest_.warning_bits = collector_.table()[kS2WarningAt];
}

}  // namespace terracut::hdl64e
