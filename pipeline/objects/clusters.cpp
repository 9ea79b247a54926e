// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "clusters.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "pipeline/stage/float_lanes.hpp"

namespace terracut::objects {
namespace {

/// True if two cells of a row are within reach of each other.
bool are_near(const frame::PointPlanes& points, std::uint32_t a, std::uint32_t b,
              const Reach& reach) noexcept {
  const float range_m = std::min(points.ground_range_m[a], points.ground_range_m[b]);
  return distance_squared_m2(points, a, b) <= reach.along_row_squared_m2(range_m);
}

}  // namespace

Clusters::Clusters(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      runs_(memory.take<Run>("objects", shape.cells())),
      run_of_(memory.take<std::uint32_t>("objects", shape.cells())),
      row_ends_(memory.take<std::uint32_t>("objects", static_cast<std::size_t>(shape.rows))),
      body_of_(memory.take<std::uint32_t>("objects", shape.cells())),
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

void Clusters::touch(std::uint32_t run, std::uint32_t other) noexcept {
  if (runs_[run].part == runs_[other].part) {
    join(run, other);
  } else {
    runs_[runs_[run].part == Part::kFoot ? run : other].is_beside_body = true;
  }
}

void Clusters::settle() noexcept {
  // A cluster's first run has the lowest number, and is final when a later run comes to it.
  for (std::uint32_t run = 0; run < count_; ++run) {
    runs_[run].cluster = runs_[runs_[run].cluster].cluster;
  }
}

void Clusters::find(const frame::RangeImage& image, std::span<const Part> parts,
                    std::span<const float> height_m, const Reach& reach) noexcept {
  const frame::PointPlanes points = image.points();
  std::ranges::fill(body_of_, kNoBody);
  count_ = 0;
  for (int row = 0; row < shape_.rows; ++row) {
    row_begin_ = count_;
    cut_row(row, points, parts, reach);
    if (row > 0) join_rows(row, points, parts, reach);
    row_ends_[static_cast<std::size_t>(row)] = count_;
  }
  settle();
  sum_up(height_m);
  join_small(points, reach);
  settle();
  add_joined();
}

void Clusters::cut_row(int row, const frame::PointPlanes& points, std::span<const Part> parts,
                       const Reach& reach) noexcept {
  const auto begin = static_cast<std::uint32_t>(shape_.cell(row, 0));
  const std::uint32_t end = begin + static_cast<std::uint32_t>(shape_.columns);
  Part before = Part::kNone;
  for (std::uint32_t cell = begin; cell < end; ++cell) {
    const Part part = parts[cell];
    if (part != Part::kNone) {
      const bool touches = before != Part::kNone && are_near(points, cell - 1, cell, reach);
      if (!touches || before != part) {
        runs_[count_] = {cell, cell, count_, part, false};
        if (touches) touch(count_, count_ - 1);
        if (goes_on_behind(count_, points, reach)) join(count_, count_ - 2);
        ++count_;
      }
      runs_[count_ - 1].end = cell + 1;
      run_of_[cell] = count_ - 1;
    }
    before = part;
  }
  const bool meet_at_seam = parts[begin] != Part::kNone && parts[end - 1] != Part::kNone;
  if (meet_at_seam && are_near(points, begin, end - 1, reach)) {
    touch(run_of_[begin], run_of_[end - 1]);
  }
}

bool Clusters::goes_on_behind(std::uint32_t run, const frame::PointPlanes& points,
                              const Reach& reach) const noexcept {
  if (run < row_begin_ + 2) return false;
  const Run &here = runs_[run], &front = runs_[run - 1], &before = runs_[run - 2];
  return before.part == here.part && before.end == front.begin && front.end == here.begin &&
         points.ground_range_m[front.begin] < points.ground_range_m[here.begin] &&
         are_near(points, before.end - 1, here.begin, reach);
}

void Clusters::join_rows(int row, const frame::PointPlanes& points, std::span<const Part> parts,
                         const Reach& reach) noexcept {
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  const auto stride = static_cast<std::uint32_t>(shape_.stride());
  const auto columns = static_cast<std::uint32_t>(shape_.columns);
  const auto row_begin = static_cast<std::uint32_t>(shape_.cell(row, 0));
  for (std::uint32_t run = row_begin_; run < count_; ++run) {
    std::uint32_t joined = kNone;  // the run below that was joined last
    for (std::uint32_t cell = runs_[run].begin; cell < runs_[run].end; ++cell) {
      const std::uint32_t below = cell - stride, column = cell - row_begin;
      const std::array<std::uint32_t, 3> others{
          below, column == 0 ? below + columns - 1 : below - 1,
          column + 1 == columns ? below + 1 - columns : below + 1};
      for (const std::uint32_t other : others) {
        if (parts[other] == Part::kNone || run_of_[other] == joined) continue;
        const float range_m = std::min(points.ground_range_m[cell], points.ground_range_m[other]);
        if (distance_squared_m2(points, cell, other) >
            reach.to_next_row_squared_m2(row - 1, range_m)) {
          continue;
        }
        joined = run_of_[other];
        touch(run, joined);
      }
    }
  }
}

void Clusters::sum_up(std::span<const float> height_m) noexcept {
  for (std::uint32_t i = 0; i < count_; ++i) {
    const Run& run = runs_[i];
    Cluster& cluster = clusters_[run.cluster];
    if (run.cluster == i) cluster = {0, height_m[run.begin], height_m[run.begin], false};
    cluster.cells += run.end - run.begin;
    cluster.is_beside_body |= run.is_beside_body;
    const std::uint32_t body = run.part == Part::kBody ? run.cluster + 1 : kNoBody;
    for (std::uint32_t cell = run.begin; cell < run.end; ++cell) {
      cluster.bottom_m = std::min(cluster.bottom_m, height_m[cell]);
      cluster.top_m = std::max(cluster.top_m, height_m[cell]);
      body_of_[cell] = body;
    }
  }
}

void Clusters::add_joined() noexcept {
  for (std::uint32_t i = 0; i < count_; ++i) {
    // The first cell of a cluster that joined another still has its old number.
    if (runs_[i].cluster == i || body_of_[runs_[i].begin] != i + 1) continue;
    const Cluster& joined = clusters_[i];
    Cluster& to = clusters_[runs_[i].cluster];
    to.cells += joined.cells;
    to.bottom_m = std::min(to.bottom_m, joined.bottom_m);
    to.top_m = std::max(to.top_m, joined.top_m);
  }
}

bool Clusters::is_part(const Cluster& cluster) const noexcept {
  const bool stands = cluster.bottom_m < config_.bottom_m && cluster.top_m > config_.upright_m;
  return cluster.cells < config_.small_cells && !stands;
}

void Clusters::join_small(const frame::PointPlanes& points, const Reach& reach) noexcept {
  for (int row = 0; row < shape_.rows; ++row) {
    const std::uint32_t end = row_ends_[static_cast<std::size_t>(row)];
    for (std::uint32_t run = row == 0 ? 0 : row_ends_[static_cast<std::size_t>(row) - 1]; run < end;
         ++run) {
      // The first cell's number is that of the cluster before any small one joined.
      const std::uint32_t body = body_of_[runs_[run].begin];
      if (body != kNoBody && is_part(clusters_[body - 1])) {
        join_around(runs_[run], row, points, reach);
      }
    }
  }
}

void Clusters::join_around(const Run& run, int row, const frame::PointPlanes& points,
                           const Reach& reach) noexcept {
  const auto row_begin = static_cast<std::uint32_t>(shape_.cell(row, 0));
  for (std::uint32_t cell = run.begin; cell < run.end; ++cell) {
    const bool is_end = cell == run.begin || cell + 1 == run.end;
    const std::size_t above = cell + static_cast<std::size_t>(shape_.stride());
    // What lies around a cell inside its cluster, the cells around find as well.
    if (!is_end && row + 1 < shape_.rows && body_of_[above] == body_of_[cell]) continue;
    const float range_m = points.ground_range_m[cell];
    const float columns = config_.join_m / std::max(range_m * reach.column_step_rad(), 0.01F);
    const int wide =
        std::min({kMostColumns, static_cast<int>(columns) + 1, (shape_.columns - 1) / 2});
    const auto column = static_cast<int>(cell - row_begin);
    const int last_row = std::min(row + kMostRows, shape_.rows - 1);
    float above_m = 0;
    for (int other_row = row; other_row <= last_row && above_m < config_.join_m; ++other_row) {
      const int begin = column - wide, end = column + wide + 1;
      join_near(cell, other_row, {std::max(begin, 0), std::min(end, shape_.columns)}, points);
      if (begin < 0) {
        join_near(cell, other_row, {begin + shape_.columns, shape_.columns}, points);
      } else if (end > shape_.columns) {
        join_near(cell, other_row, {0, end - shape_.columns}, points);
      }
      above_m += reach.row_step_rad(other_row) * range_m;
    }
  }
}

void Clusters::join_near(std::uint32_t cell, int row, frame::ColumnRange columns,
                         const frame::PointPlanes& points) noexcept {
  using stage::FourFloats, stage::FourInts;
  const std::uint32_t own = body_of_[cell];
  const auto own_body = static_cast<std::int32_t>(own);
  const float join_m2 = config_.join_m * config_.join_m;
  const std::size_t end = shape_.cell(row, columns.end);
  std::uint32_t joined = own;
  // Whole vectors of four; up to three columns more of the row do no harm.
  const std::size_t last = shape_.cell(row, 0) + static_cast<std::size_t>(shape_.stride()) - 4;
  for (std::size_t four = shape_.cell(row, columns.begin); four < end; four += 4) {
    const std::size_t other = std::min(four, last);
    FourInts bodies;
    std::memcpy(&bodies, &body_of_[other], sizeof(bodies));
    const FourInts are_others =
        (bodies != static_cast<std::int32_t>(kNoBody)) & (bodies != own_body);
    if (!stage::is_any(are_others)) continue;
    const FourFloats x_m = stage::load_four(&points.x_m[other]) - points.x_m[cell];
    const FourFloats y_m = stage::load_four(&points.y_m[other]) - points.y_m[cell];
    const FourFloats z_m = stage::load_four(&points.z_m[other]) - points.z_m[cell];
    const FourInts are_near = are_others & (x_m * x_m + y_m * y_m + z_m * z_m < join_m2);
    if (!stage::is_any(are_near)) continue;
    for (int lane = 0; lane < 4; ++lane) {
      const auto body = static_cast<std::uint32_t>(bodies[lane]);
      if (are_near[lane] == 0 || body == joined) continue;
      join(own - 1, body - 1);
      joined = body;
    }
  }
}

}  // namespace terracut::objects
