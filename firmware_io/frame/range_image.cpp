// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/range_image.hpp"

#include <algorithm>
#include <cmath>

#include "rt/vector_clones.hpp"

namespace terracut::frame {
namespace {

/// Writes intensities and return numbers of a laser's firings in adjacent cells. `numbers` has the
/// next number of each firing. A cell without a return gets arbitrary values.
TERRACUT_VECTOR_CLONES void write_run(const std::uint16_t* __restrict raw,
                                      const std::uint8_t* __restrict intensity,
                                      std::uint32_t* __restrict numbers,
                                      std::uint8_t* __restrict intensity_out,
                                      std::uint32_t* __restrict return_index) noexcept {
  for (std::size_t f = 0; f < kTileFirings; ++f) intensity_out[f] = intensity[f];
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    return_index[f] = numbers[f];
    numbers[f] += raw[f] != 0 ? 1U : 0U;
  }
}

}  // namespace

RangeImage::RangeImage(ImageShape shape, std::size_t overflow_capacity, memory::FixedMemory& memory)
    : shape_(shape),
      x_m_(memory.take<float>("range images", shape.cells())),
      y_m_(memory.take<float>("range images", shape.cells())),
      z_m_(memory.take<float>("range images", shape.cells())),
      ground_range_m_(memory.take<float>("range images", shape.cells())),
      intensity_(memory.take<std::uint8_t>("range images", shape.cells())),
      return_index_(memory.take<std::uint32_t>("range images", shape.cells())),
      overflow_(memory.take<OverflowReturn>("range images", overflow_capacity)) {
  std::ranges::fill(z_m_, kNoHeight_m);
}

void RangeImage::clear() noexcept {
  returns_ = 0;
  overflow_used_ = 0;
  std::ranges::fill(z_m_, kNoHeight_m);
}

void RangeImage::fill(const MeasuredReturns& measured, TileReader& reader) noexcept {
  clear();
  returns_ = measured.returns();
  for (std::size_t t = 0; t < measured.tiles(); ++t) {
    reader.open(measured.tile(t).heads, measured.distances(t));
    TileRow<std::uint32_t> numbers = measured.tile(t).first_return;
    for (std::size_t i = 0; i < measured.lasers(); ++i) {
      if (measured.row(t, i).returns != 0) fill_row(measured, t, i, reader, numbers);
    }
  }
}

void RangeImage::fill_row(const MeasuredReturns& measured, std::size_t tile, std::size_t laser,
                          TileReader& reader, TileRow<std::uint32_t>& numbers) noexcept {
  const MeasuredReturns::LaserRow& row = measured.row(tile, laser);
  const std::uint8_t* const intensity = measured.intensity(tile, laser);
  const std::size_t first = shape_.cell(reader.rows()[laser], 0);
  const std::size_t least = first + static_cast<std::size_t>(row.least);
  fetch_to_write(first + static_cast<std::size_t>(row.most) + 1);  // for the next tile
  // No earlier return is in the cells of a run, so what is written where there is none harms none.
  if (row.is_run && row.owned == row.returns) {
    reader.compute_points(laser,
                          {&x_m_[least], &y_m_[least], &z_m_[least], &ground_range_m_[least]});
    write_run(measured.raw(tile) + laser * kTileFirings, intensity, numbers.data(),
              &intensity_[least], &return_index_[least]);
    return;
  }
  TilePoints points;
  reader.compute_points(laser, all_of(points));
  const TileRow<std::uint16_t> columns = measured.columns(tile, laser);
  const auto point = [&](std::size_t f) noexcept {
    return Return{points.x_m[f], points.y_m[f], points.z_m[f], points.ground_range_m[f],
                  intensity[f]};
  };
  for_each_firing(row.owned,
                  [&](std::size_t f) noexcept { write(first + columns[f], point(f), numbers[f]); });
  for_each_firing(row.returns & ~row.owned, [&](std::size_t f) noexcept {
    overflow_[overflow_used_++] = {point(f), static_cast<std::uint32_t>(first + columns[f]),
                                   numbers[f]};
  });
  for (std::size_t f = 0; f < kTileFirings; ++f) numbers[f] += row.returns >> f & 1U;
}

void RangeImage::fetch_to_write(std::size_t cell) const noexcept {
  constexpr std::size_t kLineCells = 16;
  if (cell + kLineCells >= z_m_.size()) return;
  for (const std::span<float> plane : {x_m_, y_m_, z_m_, ground_range_m_}) {
    __builtin_prefetch(&plane[cell], 1, 2);
    __builtin_prefetch(&plane[cell + kLineCells], 1, 2);
  }
  __builtin_prefetch(&return_index_[cell], 1, 2);
  __builtin_prefetch(&return_index_[cell + kLineCells], 1, 2);
  __builtin_prefetch(&intensity_[cell], 1, 2);
}

void RangeImage::move(std::span<const PlanarMotions> by_row) noexcept {
  if (by_row.empty()) return;
  const auto columns = static_cast<std::size_t>(shape_.columns);
  const auto stride = static_cast<std::size_t>(shape_.stride());
  for (std::size_t row = 0; row < by_row.size(); ++row) {
    // Cells without a return are moved as well: skipping them would cost more.
    float* const __restrict x_m = x_m_.subspan(row * stride, columns).data();
    float* const __restrict y_m = y_m_.subspan(row * stride, columns).data();
    float* const __restrict ground_range_m = ground_range_m_.subspan(row * stride, columns).data();
    const PlanarMotions& motion = by_row[row];
    for (std::size_t i = 0; i < columns; ++i) {
      const float x = motion.cosine[i] * x_m[i] - motion.sine[i] * y_m[i] + motion.x_m[i];
      const float y = motion.sine[i] * x_m[i] + motion.cosine[i] * y_m[i] + motion.y_m[i];
      x_m[i] = x;
      y_m[i] = y;
      ground_range_m[i] = std::sqrt(x * x + y * y);
    }
  }
  for (OverflowReturn& extra : overflow_.first(overflow_used_)) {
    const PlanarMotions& motion = by_row[extra.cell / stride];
    const std::size_t i = extra.cell % stride;
    Return& point = extra.point;
    const float x = motion.cosine[i] * point.x_m - motion.sine[i] * point.y_m + motion.x_m[i];
    const float y = motion.sine[i] * point.x_m + motion.cosine[i] * point.y_m + motion.y_m[i];
    point.x_m = x;
    point.y_m = y;
    point.ground_range_m = std::sqrt(x * x + y * y);
  }
}

bool RangeImage::owns(std::size_t cell, const Return& point, CellOwner owner) const noexcept {
  switch (owner) {
    case CellOwner::kFirstArrived:
      return false;
    case CellOwner::kStrongest:
      return point.intensity > intensity_[cell];
    case CellOwner::kNearest:
      return point.ground_range_m < ground_range_m_[cell];
    case CellOwner::kFarthest:
      return point.ground_range_m > ground_range_m_[cell];
  }
  return false;
}

bool RangeImage::place_second(std::size_t cell, const Return& point, CellOwner owner) noexcept {
  if (overflow_used_ == overflow_.size()) return false;
  OverflowReturn& extra = overflow_[overflow_used_++];
  extra.cell = static_cast<std::uint32_t>(cell);
  if (owns(cell, point, owner)) {
    extra.point = {x_m_[cell], y_m_[cell], z_m_[cell], ground_range_m_[cell], intensity_[cell]};
    extra.return_index = return_index_[cell];
    write(cell, point, returns_);
  } else {
    extra.point = point;
    extra.return_index = returns_;
  }
  return true;
}

}  // namespace terracut::frame
