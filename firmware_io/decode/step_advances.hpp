// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "firmware_io/frame/firing_tile.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::decode {

/// Firings of a tile: all bits where one is meant, none elsewhere.
using FiringMask = frame::TileRow<std::int32_t>;

/// What follows from the head's step between two firings, for each firing of a tile. Wire azimuths
/// are rounded, so that a few steps come again and again: `Entry`, which holds what follows from
/// one of them, is made once for each.
template <class Entry>
class StepAdvances {
 public:
  explicit StepAdvances(memory::FixedMemory& memory)
      : entries_(memory.take<Entry>("decoder tables", kKnown)) {
    keys_.fill(kNone);
    in_tile_.fill(kNone);
  }

  /// Calls `make(Entry&, step_ticks, is_dual)` for steps that are not known yet, and
  /// `spread(const Entry&, const FiringMask&)` for each step among the firings; neither where all
  /// firings have the steps that they had in the tile before.
  template <class Make, class Spread>
  void spread(const frame::TileHeads& heads, Make make, Spread spread) noexcept {
    frame::TileRow<std::int64_t> keys;
    bool is_same = true;
    for (std::size_t f = 0; f < keys.size(); ++f) {
      keys[f] = std::int64_t{heads.step_ticks[f]} * 2 + (heads.is_dual >> f & 1U);
      is_same &= keys[f] == in_tile_[f];
    }
    if (is_same) return;
    in_tile_ = keys;
    for (std::uint32_t left = (1U << keys.size()) - 1, f = 0; left != 0; ++f) {
      if ((left >> f & 1U) == 0) continue;
      FiringMask mask;
      for (std::uint32_t other = 0; other < keys.size(); ++other) {
        const bool is_meant = keys[other] == keys[f];
        mask[other] = -std::int32_t{is_meant};
        left &= ~(std::uint32_t{is_meant} << other);
      }
      spread(entry_of(keys[f], make), mask);
    }
  }

 private:
  static constexpr std::int64_t kNone = -1;
  static constexpr std::size_t kKnown = 8;

  template <class Make>
  [[nodiscard]] const Entry& entry_of(std::int64_t key, Make make) noexcept {
    for (std::size_t i = 0; i < kKnown; ++i) {
      if (keys_[i] == key) return entries_[i];
    }
    const std::size_t oldest = std::exchange(next_, (next_ + 1) % kKnown);
    keys_[oldest] = key;
    make(entries_[oldest], static_cast<std::int32_t>(key / 2), key % 2 != 0);
    return entries_[oldest];
  }

  std::span<Entry> entries_;
  std::array<std::int64_t, kKnown> keys_;
  std::size_t next_ = 0;                  ///< To be replaced.
  frame::TileRow<std::int64_t> in_tile_;  ///< Of each firing.
};

}  // namespace terracut::decode
