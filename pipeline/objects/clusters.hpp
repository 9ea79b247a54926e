// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/objects/parts.hpp"
#include "pipeline/objects/reach.hpp"
#include "pipeline/objects/run.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::objects {

/// What is known of a cluster.
struct Cluster {
  Extent extent;
  std::uint32_t cells;
};

/// Clusters of body cells: neighbours within reach belong together, also across the seam, and so do
/// the two sides of what a post hides.
class Clusters {
 public:
  /// `most_runs` is how many runs an image may have.
  Clusters(frame::ImageShape shape, std::size_t most_runs, memory::FixedMemory& memory);

  /// Finds the clusters of an image. `height_m` are the heights above the ground by cell. Real-time
  /// safe.
  void find(const frame::PointPlanes& points, const Parts& parts, std::span<const float> height_m,
            const Reach& reach) noexcept TERRACUT_NONBLOCKING;

  /// Returns all runs, row by row from column 0 on.
  [[nodiscard]] std::span<const Run> runs() const noexcept { return runs_.first(count_); }
  /// Returns the extent of each run.
  [[nodiscard]] std::span<const Extent> extents() const noexcept { return extents_.first(count_); }
  /// Returns the clusters by number, in order of their first runs.
  [[nodiscard]] std::span<const Cluster> clusters() const noexcept {
    return clusters_.first(clusters_found_);
  }
  /// Returns how many body cells are in no cluster because there were too many runs.
  [[nodiscard]] std::uint32_t cells_left_out() const noexcept { return cells_left_out_; }

 private:
  void cut_row(int row, const frame::PointPlanes& points, const Parts& parts,
               std::span<const float> height_m, const Reach& reach) noexcept;
  /// Makes runs of the bodies among eight cells; both sets have the lowest bit for the first cell.
  void cut_eight(std::uint32_t eight, std::uint32_t bodies, std::uint32_t links,
                 const frame::PointPlanes& points, const Reach& reach) noexcept;
  /// True if `cell` goes on behind the last stretch where the run before that ended.
  [[nodiscard]] bool goes_on_behind(std::uint32_t cell, const frame::PointPlanes& points,
                                    const Reach& reach) const noexcept;
  /// Joins the runs of a row with those of the next lower one, which begin with `below`.
  void join_rows(int row, std::uint32_t below, const frame::PointPlanes& points,
                 const Reach& reach) noexcept;
  /// Numbers the clusters and sums up what is known of them.
  void number() noexcept;
  void join(std::uint32_t a, std::uint32_t b) noexcept;

  frame::ImageShape shape_;
  std::uint32_t count_ = 0, stretches_ = 0;
  std::uint32_t row_begin_ = 0;      // first run of the row at work
  std::uint32_t stretch_begin_ = 0;  // first run of the last stretch of the row
  std::uint32_t clusters_found_ = 0, cells_left_out_ = 0;
  std::span<Run> runs_;        // until number(), `cluster` is the stretch: linked runs of a row
  std::span<Extent> extents_;  // by run
  // By stretch: one of the same cluster, no later than itself; in number() the cluster's number.
  std::span<std::uint32_t> joined_;
  std::span<Cluster> clusters_;
};

}  // namespace terracut::objects
