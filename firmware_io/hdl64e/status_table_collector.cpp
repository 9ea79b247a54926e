// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/status_table_collector.hpp"

#include <algorithm>
#include <string_view>

namespace terracut::hdl64e {
namespace {

constexpr std::string_view kBeginning = "UNIT#";

// A laser's entry has 21 bytes: its number and 20 others. Entries are 28 bytes apart and begin
// after the first group of 7 bytes.
constexpr std::size_t kLasers = 64;
constexpr std::size_t kFirstLaserAt = 7;
constexpr std::size_t kLaserStride = 28;
constexpr std::size_t kLaserBytes = 21;

int row_of(std::int64_t cycle) noexcept {
  const auto row = static_cast<int>(cycle % kCyclesPerRound);
  return row < 0 ? row + kCyclesPerRound : row;
}

bool laser_numbers_in_place(const StatusTableCollector::Table& table) noexcept {
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    if (table[kFirstLaserAt + kLaserStride * laser] != laser) return false;
  }
  return true;
}

std::uint16_t last_word(const StatusTableCollector::Table& table) noexcept {
  return static_cast<std::uint16_t>(table[kStreamTableBytes - 2] | table[kStreamTableBytes - 1]
                                                                       << 8);
}

/// Compares only the lasers' entries; warnings, operating hours and the like may change.
bool same_lasers(const StatusTableCollector::Table& a,
                 const StatusTableCollector::Table& b) noexcept {
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    const auto from = static_cast<std::ptrdiff_t>(kFirstLaserAt + kLaserStride * laser);
    if (!std::equal(a.begin() + from, a.begin() + from + kLaserBytes, b.begin() + from))
      return false;
  }
  return true;
}

}  // namespace

std::size_t StatusTableCollector::at(std::size_t i) const noexcept {
  return (i + static_cast<std::size_t>(anchor_) * kTableBytesPerCycle) % kStreamTableBytes;
}

void StatusTableCollector::clear() noexcept {
  seen_.fill(0);
  missing_ = kStreamTableBytes;
  anchor_ = kNoAnchor;
  changed_ = false;
}

std::size_t StatusTableCollector::holes() const noexcept {
  return anchor_ == kNoAnchor ? kStreamTableBytes : missing_;
}

bool StatusTableCollector::starts_round(std::int64_t cycle) const noexcept {
  return anchor_ != kNoAnchor && row_of(cycle) == anchor_;
}

bool StatusTableCollector::begins_table(int row) const noexcept {
  const auto first = static_cast<std::size_t>(row) * kTableBytesPerCycle;
  for (std::size_t i = 0; i < kBeginning.size(); ++i) {
    if (seen_[first + i] == 0 || bytes_[first + i] != static_cast<std::uint8_t>(kBeginning[i])) {
      return false;
    }
  }
  return true;
}

void StatusTableCollector::add(std::int64_t cycle, int place, std::uint8_t value) noexcept {
  const int row = row_of(cycle);
  const std::size_t index =
      static_cast<std::size_t>(row) * kTableBytesPerCycle + static_cast<std::size_t>(place);
  if (seen_[index] == 0) {
    --missing_;
    seen_[index] = 1;
    changed_ = true;
  } else if (bytes_[index] != value) {
    seen_[index] = 1;
    changed_ = true;
  } else if (seen_[index] < 2) {
    seen_[index] = 2;
    changed_ = true;
  }
  bytes_[index] = value;

  if (static_cast<std::size_t>(place) >= kBeginning.size()) return;
  const bool begins = begins_table(row);
  const bool moved = begins && anchor_ != kNoAnchor && row != anchor_;
  const bool lost = row == anchor_ && !begins;
  if (moved || lost) {
    // A gap was longer than the stamps say, so the cycles were miscounted: the bytes collected
    // before the gap are in wrong places.
    clear();
    return;
  }
  if (begins) anchor_ = row;
}

bool StatusTableCollector::every_laser_byte_came_twice(const Table& table) const noexcept {
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    for (std::size_t i = 0; i < kLaserBytes; ++i) {
      if (seen_[at(kFirstLaserAt + kLaserStride * laser + i)] < 2) return false;
    }
  }
  return last_word(table) == kStreamTableBytes;
}

void StatusTableCollector::try_accept(bool has_crc) noexcept {
  if (!changed_ || holes() != 0) return;
  changed_ = false;
  Table table;
  std::rotate_copy(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(at(0)),
                   bytes_.end(), table.begin());
  if (!laser_numbers_in_place(table)) return;
  const bool crc_fits = stream_table_crc(table) == last_word(table);
  if (!crc_fits && (has_crc || !every_laser_byte_came_twice(table))) return;
  if (generation_ == 0 || !same_lasers(table, accepted_)) ++generation_;
  accepted_ = table;
}

}  // namespace terracut::hdl64e
