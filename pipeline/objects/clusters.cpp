// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "clusters.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "pipeline/objects/joined_sets.hpp"

namespace terracut::objects {
namespace {

using stage::FourFloats;

/// True if two cells of a row are within reach of each other.
bool are_near(const frame::PointPlanes& points, std::uint32_t a, std::uint32_t b,
              const Reach& reach) noexcept {
  const float range_m = std::min(points.ground_range_m[a], points.ground_range_m[b]);
  return distance_squared_m2(points, a, b) <= reach.along_row_squared_m2(range_m);
}

/// Returns a bit for each of the cells [cell, cell + 8), the lowest for the first: whether its
/// return is within reach of the one before it. These are not the first cells of a row.
std::uint32_t links(const frame::PointPlanes& points, std::size_t cell,
                    const Reach& reach) noexcept {
  const auto are_linked = [&](std::size_t four) noexcept -> stage::FourInts {
    const auto between = [four](const float* plane) noexcept {
      return stage::load_four(plane + four) - stage::load_four(plane + four - 1);
    };
    const FourFloats x_m = between(points.x_m), y_m = between(points.y_m),
                     z_m = between(points.z_m);
    const FourFloats range_m = lesser(stage::load_four(&points.ground_range_m[four]),
                                      stage::load_four(&points.ground_range_m[four - 1]));
    return x_m * x_m + y_m * y_m + z_m * z_m <= reach.along_row_squared_m2(range_m);
  };
  return bits_of(are_linked(cell), are_linked(cell + 4));
}

/// Returns the same for the first eight cells of a row; the first one is linked to none.
std::uint32_t first_links(const frame::PointPlanes& points, std::uint32_t cell,
                          const Reach& reach) noexcept {
  std::uint32_t links = 0;
  for (std::uint32_t i = 1; i < kEightCells; ++i) {
    if (are_near(points, cell + i - 1, cell + i, reach)) links |= 1U << i;
  }
  return links;
}

/// Applies `choose` to the lanes of each of four vectors.
template <class Choose>
FourFloats across(const std::array<FourFloats, 4>& of, Choose choose) noexcept {
  const auto halves = [&](FourFloats a, FourFloats b) noexcept {
    return choose(__builtin_shufflevector(a, b, 0, 1, 4, 5),
                  __builtin_shufflevector(a, b, 2, 3, 6, 7));
  };
  const FourFloats first = halves(of[0], of[1]), second = halves(of[2], of[3]);
  return choose(__builtin_shufflevector(first, second, 0, 2, 4, 6),
                __builtin_shufflevector(first, second, 1, 3, 5, 7));
}

Extent extent_of(const Run& run, const frame::PointPlanes& points,
                 std::span<const float> height_m) noexcept {
  const std::array<const float*, 4> planes{points.x_m, points.y_m, points.z_m, height_m.data()};
  if (run.end - run.begin < 4) {
    const auto values_m = [&](std::uint32_t cell) noexcept {
      return FourFloats{planes[0][cell], planes[1][cell], planes[2][cell], planes[3][cell]};
    };
    Extent extent{values_m(run.begin), values_m(run.begin)};
    for (std::uint32_t cell = run.begin + 1; cell < run.end; ++cell) extent.add(values_m(cell));
    return extent;
  }
  // The first four and the last four cells are all of the run.
  std::array<FourFloats, 4> least_m, most_m;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const FourFloats first_m = stage::load_four(planes[i] + run.begin);
    const FourFloats last_m = stage::load_four(planes[i] + run.end - 4);
    least_m[i] = lesser(first_m, last_m);
    most_m[i] = greater(first_m, last_m);
  }
  return {across(least_m, [](auto a, auto b) noexcept { return lesser(a, b); }),
          across(most_m, [](auto a, auto b) noexcept { return greater(a, b); })};
}

/// True if runs of adjacent rows are within reach anywhere. `run` is in the higher row, `stride`
/// cells on.
bool touch(const Run& run, const Run& lower, std::uint32_t stride, const frame::PointPlanes& points,
           const RowReach& reach) noexcept {
  const auto are_within = [&](std::uint32_t cell, std::uint32_t other) noexcept {
    const float range_m = std::min(points.ground_range_m[cell], points.ground_range_m[other]);
    return distance_squared_m2(points, cell, other) <= reach.squared_m2(range_m);
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

}  // namespace

Clusters::Clusters(frame::ImageShape shape, std::size_t most_runs, memory::FixedMemory& memory)
    : shape_(shape),
      runs_(memory.take<Run>("objects", most_runs)),
      extents_(memory.take<Extent>("objects", most_runs)),
      joined_(memory.take<std::uint32_t>("objects", most_runs)),
      clusters_(memory.take<Cluster>("objects", most_runs)) {}

void Clusters::join(std::uint32_t a, std::uint32_t b) noexcept {
  join_sets(joined_, first_of_set(joined_, a), first_of_set(joined_, b));
}

void Clusters::find(const frame::PointPlanes& points, const Parts& parts,
                    std::span<const float> height_m, const Reach& reach) noexcept {
  count_ = stretches_ = row_begin_ = cells_left_out_ = 0;
  for (int row = 0; row < shape_.rows; ++row) {
    const std::uint32_t below = row_begin_;
    row_begin_ = stretch_begin_ = count_;
    cut_row(row, points, parts, height_m, reach);
    if (row > 0) join_rows(row, below, points, reach);
  }
  number();
}

void Clusters::cut_row(int row, const frame::PointPlanes& points, const Parts& parts,
                       std::span<const float> height_m, const Reach& reach) noexcept {
  const auto begin = static_cast<std::uint32_t>(shape_.cell(row, 0));
  const std::uint32_t end = begin + static_cast<std::uint32_t>(shape_.columns);
  for (std::uint32_t eight = begin; eight < end; eight += kEightCells) {
    const std::uint32_t bodies = parts.bodies(eight);
    if (bodies == 0) continue;
    const std::uint32_t before = count_;
    cut_eight(eight, bodies,
              eight == begin ? first_links(points, eight, reach) : links(points, eight, reach),
              points, reach);
    for (std::uint32_t run = before; run < count_; ++run) {
      extents_[run] = extent_of(runs_[run], points, height_m);
    }
  }
  if (count_ > row_begin_ && runs_[row_begin_].begin == begin && runs_[count_ - 1].end == end &&
      are_near(points, begin, end - 1, reach)) {
    join(runs_[row_begin_].cluster, stretches_ - 1);
  }
}

void Clusters::cut_eight(std::uint32_t eight, std::uint32_t bodies, std::uint32_t links,
                         const frame::PointPlanes& points, const Reach& reach) noexcept {
  const bool is_body_before = count_ > row_begin_ && runs_[count_ - 1].end == eight;
  const std::uint32_t before = bodies << 1 | (is_body_before ? 1U : 0U);
  const std::uint32_t linked = bodies & before & links;
  for (std::uint32_t rest = bodies; rest != 0;) {
    if (count_ == runs_.size()) {
      cells_left_out_ += static_cast<std::uint32_t>(std::popcount(rest));
      return;
    }
    const auto first = static_cast<std::uint32_t>(std::countr_zero(rest));
    const auto length = 1 + static_cast<std::uint32_t>(std::countr_one(linked >> (first + 1)));
    const std::uint32_t begin = eight + first;
    if ((linked & 1U << first) == 0) {
      joined_[stretches_] = stretches_;
      if (goes_on_behind(begin, points, reach)) {
        join(stretches_, runs_[stretch_begin_ - 1].cluster);
      }
      stretch_begin_ = count_;
      ++stretches_;
    }
    runs_[count_++] = {begin, begin + length, stretches_ - 1};
    rest &= ~(((1U << length) - 1) << first);
  }
}

bool Clusters::goes_on_behind(std::uint32_t cell, const frame::PointPlanes& points,
                              const Reach& reach) const noexcept {
  if (stretch_begin_ == row_begin_ || stretch_begin_ == count_ || runs_[count_ - 1].end != cell) {
    return false;
  }
  const std::uint32_t front = runs_[stretch_begin_].begin, before = runs_[stretch_begin_ - 1].end;
  return before == front && points.ground_range_m[front] < points.ground_range_m[cell] &&
         are_near(points, before - 1, cell, reach);
}

void Clusters::join_rows(int row, std::uint32_t below, const frame::PointPlanes& points,
                         const Reach& reach) noexcept {
  const auto stride = static_cast<std::uint32_t>(shape_.stride());
  const RowReach row_reach = reach.to_next_row(row - 1);
  const std::span<const Run> lower_runs = runs_.subspan(below, row_begin_ - below);
  std::uint32_t stretch = stretches_, stretch_below = stretches_;  // none
  std::size_t lower = 0;
  for (const Run& run : runs_.subspan(row_begin_, count_ - row_begin_)) {
    const std::uint32_t begin_below = run.begin - stride, end_below = run.end - stride;
    while (lower < lower_runs.size() && lower_runs[lower].end < begin_below) ++lower;
    for (std::size_t i = lower; i < lower_runs.size() && lower_runs[i].begin <= end_below; ++i) {
      const Run& other = lower_runs[i];
      // Mostly the stretches of the pair before, which have been joined.
      if (run.cluster == stretch && other.cluster == stretch_below) continue;
      const std::uint32_t a = first_of_set(joined_, run.cluster),
                          b = first_of_set(joined_, other.cluster);
      if (a != b) {
        if (!touch(run, other, stride, points, row_reach)) continue;
        join_sets(joined_, a, b);
      }
      stretch = run.cluster;
      stretch_below = other.cluster;
    }
  }
}

void Clusters::number() noexcept {
  clusters_found_ = 0;
  for (std::uint32_t i = 0; i < stretches_; ++i) {
    if (joined_[i] == i) {
      joined_[i] = clusters_found_++;
    } else {
      joined_[i] = joined_[joined_[i]];  // of an earlier stretch, which has its number
    }
  }
  std::uint32_t begun = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    Run& run = runs_[i];
    run.cluster = joined_[run.cluster];
    Cluster& cluster = clusters_[run.cluster];
    if (run.cluster == begun) {  // clusters are numbered in the order of their first runs
      cluster = {extents_[i], 0};
      ++begun;
    }
    cluster.cells += run.end - run.begin;
    cluster.extent.add(extents_[i]);
  }
}

}  // namespace terracut::objects
