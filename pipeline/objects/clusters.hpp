// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/frame/range_image.hpp"
#include "pipeline/objects/part.hpp"
#include "pipeline/objects/reach.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::objects {

/// Body cells side by side in a row that belong together.
struct Run {
  std::uint32_t begin, end;  ///< Cells [begin, end), which do not cross the seam.
  std::uint32_t cluster;     ///< Its cluster's number.
};

/// What is known of a cluster.
struct Cluster {
  std::uint32_t cells = 0;
  float bottom_m = 0, top_m = 0;  ///< Heights of its lowest and highest return above the ground.
};

/// Clusters of body cells: neighbours within reach belong together, also across the seam, and so do
/// the two sides of what a post hides.
class Clusters {
 public:
  Clusters(frame::ImageShape shape, memory::FixedMemory& memory);

  /// Finds the clusters of an image. `parts` and `height_m`, height above the ground, are by
  /// cell. Real-time safe.
  void find(const frame::PointPlanes& points, std::span<const Part> parts,
            std::span<const float> height_m, const Reach& reach) noexcept TERRACUT_NONBLOCKING;

  /// Returns all runs, row by row from column 0 on.
  [[nodiscard]] std::span<const Run> runs() const noexcept { return runs_.first(count_); }
  /// Returns the clusters by number, in order of their first runs.
  [[nodiscard]] std::span<const Cluster> clusters() const noexcept {
    return clusters_.first(clusters_found_);
  }

 private:
  void cut_row(int row, const frame::PointPlanes& points, std::span<const Part> parts,
               const Reach& reach) noexcept;
  void begin_run(std::uint32_t cell, const frame::PointPlanes& points, const Reach& reach) noexcept;
  /// Joins the last runs of the row with the first, which begin at the seam.
  void close_row(std::uint32_t begin, std::uint32_t end, const frame::PointPlanes& points,
                 const Reach& reach) noexcept;
  /// True if a run begins at `cell` and the last but one before it ended there on the other side of
  /// something nearer.
  [[nodiscard]] bool goes_on_behind(std::uint32_t cell, const frame::PointPlanes& points,
                                    const Reach& reach) const noexcept;
  /// Joins the runs of a row with those of the next lower one, which are [below, row_begin_).
  void join_rows(int row, std::uint32_t below, const frame::PointPlanes& points,
                 const Reach& reach) noexcept;
  [[nodiscard]] bool touch(const Run& run, const Run& lower, int row,
                           const frame::PointPlanes& points, const Reach& reach) const noexcept;
  /// Numbers the clusters and sums up what is known of them.
  void number(std::span<const float> height_m) noexcept;
  [[nodiscard]] std::uint32_t root_of(std::uint32_t run) noexcept;
  void join(std::uint32_t a, std::uint32_t b) noexcept;

  frame::ImageShape shape_;
  std::uint32_t count_ = 0;
  std::uint32_t row_begin_ = 0;  // first run of the row at work
  std::uint32_t clusters_found_ = 0;
  std::span<Run> runs_;  // until number(), `cluster` is a run of the cluster, no later than itself
  std::span<Cluster> clusters_;
};

}  // namespace terracut::objects
