// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::stage {

/// Lays the height above the ground of every return beside its label (ReturnLabels). A return that
/// owns its cell has the height of the cell; for every other return `height_of(column, z_m,
/// ground_range_m)` tells it, from the ground below that return. All heights are finite.
///
/// Memory is taken in the constructor; the other functions are real-time safe.
class ReturnHeights {
 public:
  /// `return_capacity` is RangeImage::return_capacity() of the images to come, or that of turns.
  ReturnHeights(std::size_t return_capacity, memory::FixedMemory& memory)
      : heights_m_(memory.take<float>("return heights", return_capacity + 1)) {}

  /// Takes the heights of an image's returns.
  template <class HeightOf>
  void assign(const frame::RangeImage& image, const CellPlanes& planes,
              HeightOf height_of) noexcept;

  // The returns of a turn can be taken tile by tile, in order of arrival.

  /// Begins a turn.
  void begin() noexcept { returns_ = 0; }
  /// Takes the heights of the returns of a turn's next tile, whose cells must have their heights.
  /// `reader` is the sensor's.
  template <class HeightOf>
  void assign_tile(const frame::MeasuredReturns& turn, std::size_t tile, frame::TileReader& reader,
                   const CellPlanes& planes, HeightOf height_of) noexcept;

  /// Returns one height per return, metres, in the order of ReturnLabels::labels().
  [[nodiscard]] std::span<const float> heights_m() const noexcept {
    return heights_m_.first(returns_);
  }

 private:
  /// Writes the heights that the cells of a laser's returns have, each to the place that `next`
  /// says for its firing. Returns false if a return does not own its cell, or came late, after its
  /// empty cell was labelled: NaN is there.
  [[nodiscard]] bool take_cells(const frame::MeasuredReturns& turn, std::size_t tile,
                                std::size_t laser, const float* of_row,
                                const frame::TileRow<std::uint32_t>& next) noexcept;

  std::size_t returns_ = 0;
  std::span<float> heights_m_;
};

template <class HeightOf>
void ReturnHeights::assign(const frame::RangeImage& image, const CellPlanes& planes,
                           HeightOf height_of) noexcept {
  returns_ = image.returns();
  const auto index = image.return_index();
  const std::size_t nowhere = heights_m_.size() - 1;
  for (std::size_t cell = 0; cell < planes.label.size(); ++cell) {
    // A branch would be mispredicted. So empty cells write their height, too, to a slot that nobody
    // reads.
    heights_m_[planes.label[cell] != frame::Label::kNone ? index[cell] : nowhere] =
        planes.height_m[cell];
  }
  const auto stride = static_cast<std::size_t>(image.shape().stride());
  for (const frame::OverflowReturn& extra : image.overflow()) {
    heights_m_[extra.return_index] = height_of(static_cast<int>(extra.cell % stride),
                                               extra.point.z_m, extra.point.ground_range_m);
  }
}

template <class HeightOf>
void ReturnHeights::assign_tile(const frame::MeasuredReturns& turn, std::size_t tile,
                                frame::TileReader& reader, const CellPlanes& planes,
                                HeightOf height_of) noexcept {
  const std::span<const std::int32_t> rows = reader.rows();
  frame::TileRow<std::uint32_t> next = turn.tile(tile).first_return;
  returns_ = turn.end_of(tile);
  bool is_open = false;
  for (std::size_t i = 0; i < turn.lasers(); ++i) {
    const frame::MeasuredReturns::LaserRow& row = turn.row(tile, i);
    if (row.returns == 0) continue;
    const float* const of_row = &planes.height_m[turn.shape().cell(rows[i], 0)];
    if (!take_cells(turn, tile, i, of_row, next)) {
      if (!std::exchange(is_open, true)) reader.open(turn.tile(tile).heads, turn.distances(tile));
      frame::TilePoints own;
      reader.compute_points(i, all_of(own));
      frame::for_each_firing(row.returns, [&](std::size_t f) noexcept {
        float& height_m = heights_m_[next[f]];
        const bool owns = (row.owned >> f & 1U) != 0;
        if (owns && height_m == height_m) return;
        height_m = height_of(turn.column(tile, i, f), own.z_m[f], own.ground_range_m[f]);
      });
    }
    for (std::size_t f = 0; f < frame::kTileFirings; ++f) next[f] += row.returns >> f & 1U;
  }
}

inline bool ReturnHeights::take_cells(const frame::MeasuredReturns& turn, std::size_t tile,
                                      std::size_t laser, const float* of_row,
                                      const frame::TileRow<std::uint32_t>& next) noexcept {
  const frame::MeasuredReturns::LaserRow& row = turn.row(tile, laser);
  bool all_known = row.owned == row.returns;
  const auto take = [&](std::size_t f, float height_m) noexcept {
    heights_m_[next[f]] = height_m;
    all_known &= height_m == height_m;
  };
  if (row.is_run) {
    const float* const first = of_row + row.least;
    if (row.returns == frame::kAllFirings) {
      for (std::size_t f = 0; f < frame::kTileFirings; ++f) take(f, first[f]);
    } else {
      frame::for_each_firing(row.returns, [&](std::size_t f) noexcept { take(f, first[f]); });
    }
    return all_known;
  }
  frame::for_each_firing(
      row.returns, [&](std::size_t f) noexcept { take(f, of_row[turn.column(tile, laser, f)]); });
  return all_known;
}

}  // namespace terracut::stage
