// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "clusters.hpp"

#include <algorithm>
#include <array>
#include <bit>

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
  std::uint32_t links = 0;
  for (std::uint32_t i = 0; i < kEightCells; i += 4) {
    const auto between = [at = cell + i](const float* plane) noexcept {
      return stage::load_four(plane + at) - stage::load_four(plane + at - 1);
    };
    const FourFloats x_m = between(points.x_m), y_m = between(points.y_m),
                     z_m = between(points.z_m);
    const FourFloats range_m = lesser(stage::load_four(&points.ground_range_m[cell + i]),
                                      stage::load_four(&points.ground_range_m[cell + i - 1]));
    const stage::FourInts bits =
        (x_m * x_m + y_m * y_m + z_m * z_m <= reach.along_row_squared_m2(range_m)) &
        stage::FourInts{1, 2, 4, 8};
    links |= static_cast<std::uint32_t>(bits[0] | bits[1] | bits[2] | bits[3]) << i;
  }
  return links;
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

}  // namespace

Clusters::Clusters(frame::ImageShape shape, std::size_t most_runs, memory::FixedMemory& memory)
    : shape_(shape),
      runs_(memory.take<Run>("objects", most_runs)),
      clusters_(memory.take<Cluster>("objects", most_runs)) {}

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
  count_ = row_begin_ = cells_left_out_ = 0;
  for (int row = 0; row < shape_.rows; ++row) {
    const std::uint32_t below = row_begin_;
    row_begin_ = stretch_ = count_;
    cut_row(row, points, parts, height_m, reach);
    join_rows(row, below, points, reach);
  }
  number();
}

void Clusters::cut_row(int row, const frame::PointPlanes& points, std::span<const Part> parts,
                       std::span<const float> height_m, const Reach& reach) noexcept {
  const auto begin = static_cast<std::uint32_t>(shape_.cell(row, 0));
  const std::uint32_t end = begin + static_cast<std::uint32_t>(shape_.columns);
  for (std::uint32_t eight = begin; eight < end; eight += kEightCells) {
    const std::uint32_t bodies = among_eight(Part::kBody, parts, eight);
    if (bodies == 0) continue;
    cut_eight(eight, bodies,
              eight == begin ? first_links(points, eight, reach) : links(points, eight, reach),
              points, reach);
  }
  for (Run& run : runs_.subspan(row_begin_, count_ - row_begin_)) {
    run.extent = extent_of(run, points, height_m);
  }
  if (count_ > row_begin_ && runs_[row_begin_].begin == begin && runs_[count_ - 1].end == end &&
      are_near(points, begin, end - 1, reach)) {
    join(row_begin_, count_ - 1);
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
    Run& run = runs_[count_];
    run.begin = eight + first;
    run.end = run.begin + length;
    run.cluster = count_;
    if ((linked & 1U << first) != 0) {
      run.cluster = runs_[count_ - 1].cluster;  // only the first cell can be linked to a run before
    } else {
      if (goes_on_behind(run.begin, points, reach)) join(count_, stretch_ - 1);
      stretch_ = count_;
    }
    ++count_;
    rest &= ~(((1U << length) - 1) << first);
  }
}

bool Clusters::goes_on_behind(std::uint32_t cell, const frame::PointPlanes& points,
                              const Reach& reach) const noexcept {
  if (stretch_ == row_begin_ || stretch_ == count_ || runs_[count_ - 1].end != cell) return false;
  const std::uint32_t front = runs_[stretch_].begin, before = runs_[stretch_ - 1].end;
  return before == front && points.ground_range_m[front] < points.ground_range_m[cell] &&
         are_near(points, before - 1, cell, reach);
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
      if (runs_[run].cluster == runs_[other].cluster) continue;
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

void Clusters::number() noexcept {
  clusters_found_ = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    Run& run = runs_[i];
    if (run.cluster == i) {
      run.cluster = clusters_found_++;
      clusters_[run.cluster] = {run.extent, 0};
    } else {
      run.cluster = runs_[run.cluster].cluster;  // an earlier run, which has its number
    }
    clusters_[run.cluster].cells += run.end - run.begin;
    clusters_[run.cluster].extent.add(run.extent);
  }
}

}  // namespace terracut::objects
