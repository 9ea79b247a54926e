// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/unknown_cells.hpp"

#include <algorithm>

namespace terracut::min_cut {

UnknownCells::UnknownCells(const frame::ImageShape& shape, std::uint32_t max_unknown,
                           memory::FixedMemory& memory)
    : max_unknown_(max_unknown),
      found_{memory.take<std::uint32_t>("min-cut: cell lists", shape.cells())},
      node_of_cell_(memory.take<std::uint32_t>("min-cut: cell lists", shape.cells())),
      histogram_(memory.take<std::uint32_t>("min-cut: cell lists", kRangeSteps)) {}

void UnknownCells::find(const GridProblem& problem, std::span<const frame::Label> labels,
                        CellList& dropped) noexcept {
  found_.size = 0;
  const auto stride = static_cast<std::size_t>(problem.shape.stride());
  const auto columns = static_cast<std::size_t>(problem.shape.columns);
  for (std::size_t row = 0; row < static_cast<std::size_t>(problem.shape.rows); ++row) {
    const std::size_t first = row * stride;
    for_each_unknown(problem.seeds.subspan(first, columns), [&](std::size_t column) noexcept {
      found_.push_back(static_cast<std::uint32_t>(first + column));
    });
  }
  has_pinned_ = found_.size > max_unknown_;
  if (has_pinned_) keep_nearest(problem, labels, dropped);
  for (std::uint32_t node = 0; node < found_.size; ++node) {
    node_of_cell_[found_.storage[node]] = node;
  }
}

std::size_t UnknownCells::range_step(float ground_range_m) noexcept {
  const float step = ground_range_m * kStepsPerMetre;
  if (!(step < static_cast<float>(kRangeSteps - 1))) return kRangeSteps - 1;  // NaN as well
  return step > 0 ? static_cast<std::size_t>(step) : 0;
}

void UnknownCells::keep_nearest(const GridProblem& problem, std::span<const frame::Label> labels,
                                CellList& dropped) noexcept {
  std::fill(histogram_.begin(), histogram_.end(), 0U);
  for (const std::uint32_t cell : found_.view()) {
    ++histogram_[range_step(problem.ground_range_m[cell])];
  }
  std::size_t last_step = 0;
  std::uint32_t nearer = 0;
  while (nearer + histogram_[last_step] <= max_unknown_) nearer += histogram_[last_step++];
  std::uint32_t room_in_last_step = max_unknown_ - nearer;

  const std::uint32_t found = found_.size;
  found_.size = 0;
  for (const std::uint32_t cell : found_.storage.first(found)) {
    const std::size_t step = range_step(problem.ground_range_m[cell]);
    if (step < last_step || (step == last_step && room_in_last_step > 0)) {
      if (step == last_step) --room_in_last_step;
      found_.push_back(cell);
    } else {
      node_of_cell_[cell] =
          labels[cell] == frame::Label::kObstacle ? kPinnedObstacle : kPinnedGround;
      dropped.push_back(cell);
    }
  }
}

}  // namespace terracut::min_cut
