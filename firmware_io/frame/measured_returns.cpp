// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/measured_returns.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "rt/vector_clones.hpp"

namespace terracut::frame {
namespace {

constexpr std::size_t kWordBits = 64;

/// A flag, 0 or 1, for each firing.
using Flags = std::uint8_t[kTileFirings];

/// Packs the flags into one bit for each firing.
[[gnu::always_inline]] inline std::uint32_t bits_of_firings(const Flags& flags) noexcept {
  static_assert(kTileFirings == 24 && std::endian::native == std::endian::little);
  std::uint32_t bits = 0;
  for (unsigned eighth = 0; eighth < 3; ++eighth) {
    std::uint64_t bytes;
    std::memcpy(&bytes, flags + 8 * eighth, sizeof(bytes));
    // The multiplication moves bit 0 of byte i to bit 56 + i.
    const std::uint64_t gathered = bytes * 0x0102'0408'1020'4080U >> 56U;
    bits |= static_cast<std::uint32_t>(gathered) << (8 * eighth);
  }
  return bits;
}

/// Returns the mask of firings that have a return.
[[gnu::always_inline]] inline std::uint32_t hits_of(const std::uint16_t* raw) noexcept {
  Flags is_hit;
  for (std::size_t f = 0; f < kTileFirings; ++f) is_hit[f] = raw[f] != 0;
  return bits_of_firings(is_hit);
}

/// Returns the mask of firings for which `holds(value, value of the previous firing)`.
template <class Value, class Holds>
[[gnu::always_inline]] inline std::uint32_t where_after(const Value* values, Holds holds) noexcept {
  Flags flags{};
  for (std::size_t f = 1; f < kTileFirings; ++f) flags[f] = holds(values[f], values[f - 1]);
  return bits_of_firings(flags);
}

/// Returns the mask of firings whose columns are in [begin, end).
std::uint32_t inside(const BeamColumns& beam, std::int32_t begin, std::int32_t end) noexcept {
  std::uint32_t bits = 0;
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    const bool is_inside = beam.column[f] >= begin && beam.column[f] < end;
    bits |= std::uint32_t{is_inside} << f;
  }
  return bits;
}

/// Returns the bits of 64 columns, starting with `column`.
std::uint64_t bits_from(std::span<const std::uint64_t> bits, std::size_t column) noexcept {
  const std::size_t word = column / kWordBits, shift = column % kWordBits;
  return shift == 0 ? bits[word] : bits[word] >> shift | bits[word + 1] << (kWordBits - shift);
}
void add_bits(std::span<std::uint64_t> bits, std::size_t column, std::uint64_t added) noexcept {
  const std::size_t word = column / kWordBits, shift = column % kWordBits;
  bits[word] |= added << shift;
  if (shift != 0) bits[word + 1] |= added >> (kWordBits - shift);
}

/// Marks the cells of a laser whose firings are in adjacent columns from `least` on as taken; false
/// if one of them was taken already.
[[gnu::always_inline]] inline bool take_run(std::span<std::uint64_t> cells, std::int32_t least,
                                            std::uint32_t hits,
                                            MeasuredReturns::LaserRow& row) noexcept {
  const auto column = static_cast<std::size_t>(least);
  if ((bits_from(cells, column) & kAllFirings) != 0) return false;
  add_bits(cells, column, hits);
  row = {least, least + int{kTileFirings} - 1, hits, hits, true};
  return true;
}

TERRACUT_VECTOR_CLONES void find_hits(const std::uint16_t* raw, std::size_t lasers,
                                      std::uint32_t* hits) noexcept {
  for (std::size_t i = 0; i < lasers; ++i) hits[i] = hits_of(raw + i * kTileFirings);
}

/// Counts the returns of each firing, for a tile of which all returns are in one frame.
TERRACUT_VECTOR_CLONES void count_all(const std::uint16_t* __restrict raw, std::size_t lasers,
                                      std::uint16_t* __restrict counts) noexcept {
  for (std::size_t i = 0; i < lasers; ++i) {
    for (std::size_t f = 0; f < kTileFirings; ++f) {
      const bool is_hit = raw[i * kTileFirings + f] != 0;
      counts[f] = static_cast<std::uint16_t>(counts[f] + std::uint16_t{is_hit});
    }
  }
}

}  // namespace

MeasuredReturns::MeasuredReturns(ImageShape shape, std::size_t lasers, std::size_t tiles,
                                 memory::FixedMemory& memory, bool has_fine)
    : shape_(shape),
      lasers_(lasers),
      words_(static_cast<std::size_t>(shape.columns) / kWordBits + 2),
      tiles_(memory.take<Tile>("measured returns", tiles)),
      rows_(memory.take<LaserRow>("measured returns", tiles * lasers_)),
      raw_(memory.take<std::uint16_t>("measured returns", tiles * lasers_ * kTileFirings)),
      fine_(memory.take<std::uint8_t>("measured returns", has_fine ? raw_.size() : 0)),
      columns_(memory.take<std::uint16_t>("measured returns", raw_.size())),
      intensity_(memory.take<std::uint8_t>("measured returns", raw_.size())),
      taken_(memory.take<std::uint64_t>("measured returns",
                                        static_cast<std::size_t>(shape.rows) * words_)) {}

void MeasuredReturns::clear(std::int64_t turn) noexcept {
  turn_ = turn;
  used_ = 0;
  returns_ = 0;
  std::fill(taken_.begin(), taken_.end(), std::uint64_t{0});
}

std::uint32_t MeasuredReturns::add(const NewTile& tile, CellOwner owner,
                                   TileReader& reader) noexcept {
  if (used_ == tiles_.size()) {
    std::uint32_t lost = 0;
    for (std::size_t i = 0; i < lasers_; ++i) {
      const std::uint32_t in_frame =
          inside(tile.beams[i], tile.first_column, tile.first_column + shape_.columns);
      lost += static_cast<std::uint32_t>(
          std::popcount(hits_of(tile.distances.raw + i * kTileFirings) & in_frame));
    }
    return lost;
  }
  const std::size_t values = lasers_ * kTileFirings;
  std::memcpy(&raw_[used_ * values], tile.distances.raw, values * sizeof(tile.distances.raw[0]));
  if (!fine_.empty()) std::memcpy(&fine_[used_ * values], tile.distances.fine, values);
  std::memcpy(&intensity_[used_ * values], tile.intensity, values);
  Tile& added = tiles_[used_];
  added = {.heads = tile.heads,
           .first_return = {},
           .least = shape_.columns,
           .most = -1,
           .first_ns = tile.first_ns,
           .last_ns = tile.last_ns};
  const std::size_t number = used_++;
  open_ = kNoTile;
  const std::span<const std::int32_t> rows = reader.rows();
  std::array<std::uint32_t, kMostLasers> hits;
  find_hits(tile.distances.raw, lasers_, hits.data());
  const std::int32_t first = tile.first_column, end = first + shape_.columns;
  const std::span<LaserRow> of_tile = rows_.subspan(number * lasers_, lasers_);
  for (std::size_t i = 0; i < lasers_; ++i) {
    const BeamColumns& beam = tile.beams[i];
    LaserRow& row = of_tile[i];
    const bool is_run = beam.is_one_run && beam.least >= first && beam.most < end;
    if (!is_run || !take_run(bits_of(taken_, rows[i]), beam.least - first, hits[i], row))
        [[unlikely]] {
      take_cells(tile, i, hits[i], rows[i], owner, reader);
    }
    if (row.returns == 0) continue;
    added.least = std::min(added.least, row.least);
    added.most = std::max(added.most, row.most);
  }
  const std::uint32_t before = returns_;
  fetch_next();
  number_returns(tile, added, of_tile);
  if (returns_ == before) --used_;  // nothing of the tile belongs to this frame
  return 0;
}

void MeasuredReturns::fetch_next() const noexcept {
  constexpr std::size_t kLineBytes = 64;
  if (used_ == tiles_.size()) return;
  const auto fetch = [](const auto& of, std::size_t begin, std::size_t count) noexcept {
    const auto* const bytes = reinterpret_cast<const std::byte*>(&of[begin]);
    for (std::size_t at = 0; at < count * sizeof(of[0]); at += kLineBytes) {
      __builtin_prefetch(bytes + at, 1, 2);
    }
  };
  const std::size_t values = lasers_ * kTileFirings;
  fetch(tiles_, used_, 1);
  fetch(rows_, used_ * lasers_, lasers_);
  fetch(raw_, used_ * values, values);
  if (!fine_.empty()) fetch(fine_, used_ * values, values);
  fetch(intensity_, used_ * values, values);
}

void MeasuredReturns::number_returns(const NewTile& tile, Tile& added,
                                     std::span<const LaserRow> rows) noexcept {
  TileRow<std::uint16_t> counts{};
  bool is_whole = true;
  for (const BeamColumns& beam : tile.beams) {
    is_whole &= beam.least >= tile.first_column && beam.most < tile.first_column + shape_.columns;
  }
  if (is_whole) {
    count_all(tile.distances.raw, lasers_, counts.data());
  } else {
    for (const LaserRow& row : rows) {
      for_each_firing(row.returns, [&](std::size_t f) noexcept { ++counts[f]; });
    }
  }
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    added.first_return[f] = returns_;
    returns_ += counts[f];
  }
}

void MeasuredReturns::take_cells(const NewTile& tile, std::size_t laser, std::uint32_t hits,
                                 int row, CellOwner owner, TileReader& reader) noexcept {
  const BeamColumns& beam = tile.beams[laser];
  const std::int32_t first = tile.first_column, end = first + shape_.columns;
  LaserRow& taken = row_at(used_ - 1, laser);
  const std::span<std::uint64_t> cells = bits_of(taken_, row);
  const bool is_whole = beam.least >= first && beam.most < end;
  const std::int32_t least = std::max(beam.least, first) - first;
  taken = {.least = least,
           .most = std::min(beam.most, end - 1) - first,
           .returns = is_whole ? hits : hits & inside(beam, first, end),
           .owned = 0,
           .is_run = false};
  if (taken.returns == 0) {
    taken.most = -1;
    return;
  }
  std::uint16_t* const columns = &columns_[((used_ - 1) * lasers_ + laser) * kTileFirings];
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    columns[f] = static_cast<std::uint16_t>(beam.column[f] - first);
  }
  std::uint32_t left = taken.returns;
  // Usually the laser's returns lie within 64 columns, whose bits are loaded at once.
  if (taken.most - least < static_cast<std::int32_t>(kWordBits)) [[likely]] {
    const auto column = static_cast<std::size_t>(least);
    const std::uint64_t before = bits_from(cells, column);
    std::uint64_t now = before;
    for_each_firing(left, [&](std::size_t f) noexcept {
      const std::uint64_t bit = std::uint64_t{1} << (columns[f] - static_cast<unsigned>(least));
      const bool is_free = (now & bit) == 0;
      now |= bit;
      taken.owned |= std::uint32_t{is_free} << f;
    });
    add_bits(cells, column, now & ~before);
    left &= ~taken.owned;
    left &= ~take_pairs(laser, left, owner, reader);
  }
  for_each_firing(left, [&](std::size_t f) noexcept {
    take_cell({used_ - 1, laser, f}, row, columns[f], owner, reader);
  });
}

std::uint32_t MeasuredReturns::take_pairs(std::size_t laser, std::uint32_t left, CellOwner owner,
                                          TileReader& reader) noexcept {
  LaserRow& taken = row_at(used_ - 1, laser);
  const std::size_t values = ((used_ - 1) * lasers_ + laser) * kTileFirings;
  const std::uint16_t* const columns = &columns_[values];
  const std::uint32_t pairs =
      left & taken.owned << 1U &
      where_after(columns, [](std::uint16_t own, std::uint16_t before) { return own == before; });
  if (pairs == 0) return 0;
  const std::uint32_t won = pairs & [&]() noexcept -> std::uint32_t {
    const auto is_more = [](auto own, auto before) { return own > before; };
    const auto is_less = [](auto own, auto before) { return own < before; };
    switch (owner) {
      case CellOwner::kFirstArrived:
        break;
      case CellOwner::kStrongest:
        return where_after(&intensity_[values], is_more);
      case CellOwner::kNearest:
        return where_after(ground_ranges_m(used_ - 1, laser, reader).data(), is_less);
      case CellOwner::kFarthest:
        return where_after(ground_ranges_m(used_ - 1, laser, reader).data(), is_more);
    }
    return 0;
  }();
  taken.owned ^= won | won >> 1U;
  return pairs;
}

void MeasuredReturns::take_cell(const Place& at, int row, int column, CellOwner owner,
                                TileReader& reader) noexcept {
  const auto bit = static_cast<std::size_t>(column);
  const std::uint64_t mask = std::uint64_t{1} << (bit % kWordBits);
  std::uint64_t& word = bits_of(taken_, row)[bit / kWordBits];
  LaserRow& mine = row_at(at.tile, at.laser);
  const std::uint32_t firing = 1U << at.firing;
  if ((word & mask) == 0) {
    word |= mask;
    mine.owned |= firing;
    return;
  }
  if (owner == CellOwner::kFirstArrived) return;
  const Place other = owner_before(at, row, column, reader);
  if (!goes_before(at, other, owner, reader)) return;
  mine.owned |= firing;
  row_at(other.tile, other.laser).owned &= ~(1U << other.firing);
}

MeasuredReturns::Place MeasuredReturns::owner_before(const Place& newest, int row, int column,
                                                     TileReader& reader) const noexcept {
  // Usually the return that owns the cell comes from the same firing or from the previous one.
  const std::uint32_t owned = this->row(newest.tile, newest.laser).owned;
  for (std::size_t f = newest.firing; f-- > 0;) {
    const bool is_owner = (owned >> f & 1U) != 0;
    if (is_owner && this->column(newest.tile, newest.laser, f) == column) {
      return {newest.tile, newest.laser, f};
    }
  }
  const std::span<const std::int32_t> rows = reader.rows();
  for (std::size_t t = newest.tile + 1; t-- > 0;) {
    const bool is_at_work = t == newest.tile;
    if (!is_at_work && (tiles_[t].least > column || tiles_[t].most < column)) continue;
    for (std::size_t i = 0; i < (is_at_work ? newest.laser + 1 : lasers_); ++i) {
      const LaserRow& candidate = this->row(t, i);
      if (rows[i] != row || candidate.least > column || candidate.most < column) continue;
      for (std::uint32_t bits = candidate.owned; bits != 0; bits &= bits - 1) {
        const auto f = static_cast<std::size_t>(std::countr_zero(bits));
        if (this->column(t, i, f) == column) return {t, i, f};
      }
    }
  }
  return {};
}

bool MeasuredReturns::goes_before(const Place& newer, const Place& older, CellOwner owner,
                                  TileReader& reader) noexcept {
  const auto intensity = [&](const Place& at) noexcept {
    return intensity_[(at.tile * lasers_ + at.laser) * kTileFirings + at.firing];
  };
  const auto range_m = [&](const Place& at) noexcept {
    return ground_ranges_m(at.tile, at.laser, reader)[at.firing];
  };
  switch (owner) {
    case CellOwner::kFirstArrived:
      return false;
    case CellOwner::kStrongest:
      return intensity(newer) > intensity(older);
    case CellOwner::kNearest:
      return range_m(newer) < range_m(older);
    case CellOwner::kFarthest:
      return range_m(newer) > range_m(older);
  }
  return false;
}

TileRow<float> MeasuredReturns::ground_ranges_m(std::size_t tile, std::size_t laser,
                                                TileReader& reader) noexcept {
  TilePoints points;
  if (std::exchange(open_, tile) != tile) reader.open(tiles_[tile].heads, distances(tile));
  reader.compute_points(laser, all_of(points));
  return points.ground_range_m;
}

}  // namespace terracut::frame
