// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "firmware_io/frame/firing_tile.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::decode {

/// Selects firings of a tile: all bits are set for a selected firing, none for the others.
using FiringMask = frame::TileRow<std::int32_t>;

/// Caches values that depend on the rotation from one firing to the next, for each firing of a
/// tile. Azimuths are rounded when sent, so only a few different steps occur: each gets one
/// `Entry`.
template <class Entry>
class StepAdvances {
 public:
  explicit StepAdvances(memory::FixedMemory& memory)
      : entries_(memory.take<Entry>("decoder tables", kKnown)) {
    keys_.fill(kNone);
    in_tile_.fill(kNone);
  }

  /// Updates the tile's values. Calls `make(Entry&, step_ticks, is_dual)` for each step not cached,
  /// `fill(const Entry&)` with the first firing's step for all firings, then `spread(const Entry&,
  /// const FiringMask&)` for each other step. Calls nothing if every firing has the same step as in
  /// the last tile.
  template <class Make, class Fill, class Spread>
  void spread(const frame::TileHeads& heads, Make make, Fill fill, Spread spread) noexcept {
    Keys keys;
    for (std::size_t f = 0; f < keys.size(); ++f) keys[f] = 2 * heads.step_ticks[f];
    frame::for_each_firing(heads.is_dual, [&](std::size_t f) noexcept { ++keys[f]; });
    if (keys == in_tile_) return;
    in_tile_ = keys;
    fill(entry_of(keys[0], make));
    for (std::uint32_t left = others(keys, 0).bits; left != 0;) {
      const auto f = static_cast<std::size_t>(std::countr_zero(left));
      const Others different = others(keys, f);
      spread(entry_of(keys[f], make), different.same);
      left &= different.bits;
    }
  }

 private:
  /// The key of each firing: twice its step, plus one if the firing is one of two returns.
  using Keys = frame::TileRow<std::int32_t>;
  static constexpr std::int32_t kNone = -1;
  static constexpr std::size_t kKnown = 8;

  /// The firings that share one key (`same`), and a bit for each firing that has another.
  struct Others {
    FiringMask same;
    std::uint32_t bits = 0;
  };
  [[nodiscard]] static Others others(const Keys& keys, std::size_t firing) noexcept {
    Others found;
    for (std::size_t f = 0; f < keys.size(); ++f) {
      found.same[f] = -std::int32_t{keys[f] == keys[firing]};
    }
    for (std::size_t f = 0; f < keys.size(); ++f) {
      found.bits |= static_cast<std::uint32_t>(~found.same[f]) & 1U << f;
    }
    return found;
  }

  template <class Make>
  [[nodiscard]] const Entry& entry_of(std::int32_t key, Make make) noexcept {
    for (std::size_t i = 0; i < kKnown; ++i) {
      if (keys_[i] == key) return entries_[i];
    }
    const std::size_t oldest = std::exchange(next_, (next_ + 1) % kKnown);
    keys_[oldest] = key;
    make(entries_[oldest], key / 2, key % 2 != 0);
    return entries_[oldest];
  }

  std::span<Entry> entries_;
  std::array<std::int32_t, kKnown> keys_;
  std::size_t next_ = 0;  ///< Index of the entry to be replaced next.
  Keys in_tile_;          ///< The keys of the last tile.
};

}  // namespace terracut::decode
