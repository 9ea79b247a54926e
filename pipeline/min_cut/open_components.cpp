// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/open_components.hpp"

#include <algorithm>
#include <utility>

namespace terracut::min_cut {

OpenComponents::OpenComponents(const frame::ImageShape& shape, std::size_t capacity,
                               memory::FixedMemory& memory)
    : shape_(shape),
      cells_(memory.take<Cell>("min-cut: open components", capacity)),
      free_(memory.take<std::uint32_t>("min-cut: open components", capacity)),
      roots_(memory.take<std::uint32_t>("min-cut: open components", capacity)) {
  for (std::span<std::uint32_t>* row : {&here_, &below_}) {
    *row = memory.take<std::uint32_t>("min-cut: open components",
                                      static_cast<std::size_t>(shape.columns));
  }
  for (std::span<std::uint32_t>* column : {&last_, &next_last_}) {
    *column = memory.take<std::uint32_t>("min-cut: open components",
                                         static_cast<std::size_t>(shape.rows));
  }
}

void OpenComponents::begin(int column) noexcept {
  column_ = column;
  open_ = 0;
  waiting_columns_ = 0;
  free_count_ = static_cast<std::uint32_t>(free_.size());
  for (std::uint32_t i = 0; i < free_count_; ++i) free_[i] = free_count_ - 1 - i;
  std::ranges::fill(last_, kNone);
}

OpenComponents::Released OpenComponents::take(int count, std::span<Seed> seeds) noexcept {
  while (count > 0) {
    const int end = std::min(column_ + count, shape_.columns);
    take_piece({column_, end}, seeds);
    taken_ += static_cast<std::uint32_t>(end - column_);
    count -= end - column_;
    column_ = end == shape_.columns ? 0 : end;
  }
  return release(static_cast<std::uint32_t>(shape_.columns / 8), seeds);
}

OpenComponents::Released OpenComponents::release_all(std::span<Seed> seeds) noexcept {
  return release(0, seeds);
}

void OpenComponents::take_piece(frame::ColumnRange columns, std::span<Seed> seeds) noexcept {
  std::ranges::fill(next_last_, kNone);
  for (int row = 0; row < shape_.rows; ++row) {
    std::swap(here_, below_);
    const std::size_t first = shape_.cell(row, columns.begin);
    for_each_unknown(seeds.subspan(first, columns.size()), [&](std::size_t i) noexcept {
      const std::size_t cell = first + i;
      const std::uint32_t id = free_[--free_count_];
      const std::uint32_t column = taken_ + static_cast<std::uint32_t>(i);
      cells_[id] = {static_cast<std::uint32_t>(cell), id, id, column, column};
      roots_[open_++] = id;
      seeds[cell] = Seed::kWaiting;
      here_[i] = id;
      const auto waits = [&](std::size_t other) { return seeds[other] == Seed::kWaiting; };
      if (i > 0 && waits(cell - 1)) join(id, here_[i - 1]);
      if (row > 0) {
        const std::size_t below = cell - static_cast<std::size_t>(shape_.stride());
        if (i > 0 && waits(below - 1)) join(id, below_[i - 1]);
        if (waits(below)) join(id, below_[i]);
        if (i + 1 < columns.size() && waits(below + 1)) join(id, below_[i + 1]);
      }
      if (i == 0) join_beside(id, last_, row);
      if (i + 1 == columns.size()) next_last_[static_cast<std::size_t>(row)] = id;
    });
  }
  std::swap(last_, next_last_);
}

void OpenComponents::join_beside(std::uint32_t id, std::span<const std::uint32_t> column,
                                 int row) noexcept {
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, shape_.rows - 1); ++r) {
    const std::uint32_t other = column[static_cast<std::size_t>(r)];
    if (other != kNone) join(id, other);
  }
}

std::uint32_t OpenComponents::root_of(std::uint32_t id) noexcept {
  while (cells_[id].parent != id) {
    id = cells_[id].parent = cells_[cells_[id].parent].parent;
  }
  return id;
}

void OpenComponents::join(std::uint32_t a, std::uint32_t b) noexcept {
  a = root_of(a);
  b = root_of(b);
  if (a == b) return;
  const auto is_before = [](std::uint32_t one, std::uint32_t other) {
    return static_cast<std::int32_t>(one - other) < 0;
  };
  cells_[a].parent = b;
  std::swap(cells_[a].next, cells_[b].next);  // two rings become one
  if (is_before(cells_[a].first_column, cells_[b].first_column)) {
    cells_[b].first_column = cells_[a].first_column;
  }
  if (is_before(cells_[b].last_column, cells_[a].last_column)) {
    cells_[b].last_column = cells_[a].last_column;
  }
}

OpenComponents::Released OpenComponents::release(std::uint32_t most_columns,
                                                 std::span<Seed> seeds) noexcept {
  Released released;
  std::uint32_t first_ago = 0, last_ago = 0, waits_since = 0, kept = 0;
  for (std::uint32_t i = 0; i < open_; ++i) {
    const std::uint32_t root = roots_[i];
    const Cell component = cells_[root];
    if (component.parent != root) continue;  // joined with another
    const std::uint32_t began_ago = taken_ - component.first_column;
    const bool is_open = component.last_column + 1 == taken_;
    if (is_open && began_ago <= most_columns) {
      waits_since = std::max(waits_since, began_ago);
      roots_[kept++] = root;
      continue;
    }
    if (released.cells == 0) last_ago = taken_ - component.last_column;
    first_ago = std::max(first_ago, began_ago);
    last_ago = std::min(last_ago, taken_ - component.last_column);
    if (is_open) {
      for (std::uint32_t& last : last_) {
        if (last != kNone && root_of(last) == root) last = kNone;
      }
    }
    std::uint32_t id = root;
    do {
      seeds[cells_[id].cell] = Seed::kUnknown;
      free_[free_count_++] = id;
      ++released.cells;
      released.cells_open += is_open ? 1 : 0;
      id = cells_[id].next;
    } while (id != root);
  }
  open_ = kept;
  waiting_columns_ = static_cast<int>(waits_since);
  if (released.cells == 0) return released;
  const int begin = column_ - static_cast<int>(first_ago);
  released.window = {begin < 0 ? begin + shape_.columns : begin,
                     static_cast<int>(first_ago - last_ago) + 1};
  return released;
}

}  // namespace terracut::min_cut
