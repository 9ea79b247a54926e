// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "clusters.hpp"

#include <algorithm>

namespace terracut::objects {
namespace {

/// True if two cells of a row are within reach of each other.
bool are_near(const frame::PointPlanes& points, std::uint32_t a, std::uint32_t b,
              const Reach& reach) noexcept {
  const float range_m = std::min(points.ground_range_m[a], points.ground_range_m[b]);
  return distance_squared_m2(points, a, b) <= reach.along_row_squared_m2(range_m);
}

}  // namespace

Clusters::Clusters(frame::ImageShape shape, memory::FixedMemory& memory)
    : shape_(shape),
      runs_(memory.take<Run>("objects", shape.cells())),
      clusters_(memory.take<Cluster>("objects", shape.cells())) {}

std::uint32_t Clusters::root_of(std::uint32_t run) noexcept {
  while (runs_[run].cluster != run) {
    runs_[run].cluster = runs_[runs_[run].cluster].cluster;
    run = runs_[run].cluster;
  }
  return run;
}

void Clusters::join(std::uint32_t a, std::uint32_t b) noexcept {
  a = root_of(a);
  b = root_of(b);
  runs_[std::max(a, b)].cluster = std::min(a, b);
}

void Clusters::find(const frame::PointPlanes& points, std::span<const Part> parts,
                    std::span<const float> height_m, const Reach& reach) noexcept {
  count_ = row_begin_ = 0;
  for (int row = 0; row < shape_.rows; ++row) {
    const std::uint32_t below = row_begin_;
    row_begin_ = count_;
    cut_row(row, points, parts, reach);
    join_rows(row, below, points, reach);
  }
  number(height_m);
}

void Clusters::cut_row(int row, const frame::PointPlanes& points, std::span<const Part> parts,
                       const Reach& reach) noexcept {
  const auto begin = static_cast<std::uint32_t>(shape_.cell(row, 0));
  const std::uint32_t end = begin + static_cast<std::uint32_t>(shape_.columns);
  for (std::uint32_t cell = begin; cell < end;) {
    const std::uint32_t last = std::min(cell + kEightCells, end);
    if (!is_among_eight(Part::kBody, parts, cell)) {
      cell = last;
      continue;
    }
    for (; cell < last; ++cell) {
      if (parts[cell] != Part::kBody) continue;
      const bool goes_on = count_ > row_begin_ && runs_[count_ - 1].end == cell &&
                           are_near(points, cell - 1, cell, reach);
      if (!goes_on) begin_run(cell, points, reach);
      runs_[count_ - 1].end = cell + 1;
    }
  }
  if (count_ > row_begin_) close_row(begin, end, points, reach);
}

void Clusters::begin_run(std::uint32_t cell, const frame::PointPlanes& points,
                         const Reach& reach) noexcept {
  runs_[count_] = {cell, cell, count_};
  if (goes_on_behind(cell, points, reach)) join(count_, count_ - 2);
  ++count_;
}

void Clusters::close_row(std::uint32_t begin, std::uint32_t end, const frame::PointPlanes& points,
                         const Reach& reach) noexcept {
  if (runs_[row_begin_].begin == begin && runs_[count_ - 1].end == end &&
      are_near(points, begin, end - 1, reach)) {
    join(row_begin_, count_ - 1);
  }
}

bool Clusters::goes_on_behind(std::uint32_t cell, const frame::PointPlanes& points,
                              const Reach& reach) const noexcept {
  if (count_ < row_begin_ + 2) return false;
  const Run &front = runs_[count_ - 1], &before = runs_[count_ - 2];
  return before.end == front.begin && front.end == cell &&
         points.ground_range_m[front.begin] < points.ground_range_m[cell] &&
         are_near(points, before.end - 1, cell, reach);
}

void Clusters::join_rows(int row, std::uint32_t below, const frame::PointPlanes& points,
                         const Reach& reach) noexcept {
  const auto stride = static_cast<std::uint32_t>(shape_.stride());
  const std::uint32_t end = row_begin_;
  std::uint32_t lower = below;
  for (std::uint32_t run = row_begin_; run < count_; ++run) {
    const std::uint32_t begin_below = runs_[run].begin - stride,
                        end_below = runs_[run].end - stride;
    while (lower < end && runs_[lower].end < begin_below) ++lower;
    for (std::uint32_t other = lower; other < end && runs_[other].begin <= end_below; ++other) {
      if (touch(runs_[run], runs_[other], row, points, reach)) join(run, other);
    }
  }
}

bool Clusters::touch(const Run& run, const Run& lower, int row, const frame::PointPlanes& points,
                     const Reach& reach) const noexcept {
  const auto stride = static_cast<std::uint32_t>(shape_.stride());
  const auto are_within = [&](std::uint32_t cell, std::uint32_t other) {
    const float range_m = std::min(points.ground_range_m[cell], points.ground_range_m[other]);
    return distance_squared_m2(points, cell, other) <=
           reach.to_next_row_squared_m2(row - 1, range_m);
  };
  const std::uint32_t begin = std::max(run.begin, lower.begin + stride);
  const std::uint32_t end = std::min(run.end, lower.end + stride);
  // Runs that only meet at a corner:
  if (begin == end) {
    return run.begin == end ? are_within(begin, begin - stride - 1)
                            : are_within(begin - 1, begin - stride);
  }
  for (std::uint32_t cell = begin; cell < end; ++cell) {
    if (are_within(cell, cell - stride)) return true;
  }
  return false;
}

void Clusters::number(std::span<const float> height_m) noexcept {
  clusters_found_ = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    Run& run = runs_[i];
    if (run.cluster == i) {
      run.cluster = clusters_found_++;
      clusters_[run.cluster] = {0, height_m[run.begin], height_m[run.begin]};
    } else {
      run.cluster = runs_[run.cluster].cluster;  // an earlier run, which has its number
    }
    Cluster& cluster = clusters_[run.cluster];
    cluster.cells += run.end - run.begin;
    for (std::uint32_t cell = run.begin; cell < run.end; ++cell) {
      cluster.bottom_m = std::min(cluster.bottom_m, height_m[cell]);
      cluster.top_m = std::max(cluster.top_m, height_m[cell]);
    }
  }
}

}  // namespace terracut::objects
