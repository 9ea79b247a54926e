// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/frame/range_image.hpp"
#include "pipeline/objects/parts.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::objects {

/// Cells side by side in a row that belong together.
struct Run {
  std::uint32_t begin, end;  ///< Cells [begin, end), which do not cross the seam.
  std::uint32_t cluster;     ///< The first run of its cluster, whose own number this is.
  Part part;
  bool is_beside_body;  ///< The run is a foot and touches a body.
};

/// What is known of a cluster.
struct Cluster {
  std::uint32_t cells = 0;
  float bottom_m = 0, top_m = 0;  ///< Heights of its lowest and highest return above the ground.
  bool is_beside_body = false;    ///< Of feet: a body touches them.
};

/// Clusters of obstacle cells. Neighbours of one part (also diagonal ones, also across the seam)
/// within reach belong together, and so do the two sides of what a post hides. Then small clusters
/// of bodies join what lies around them, across empty cells: they may be what is seen of an object
/// through glass or beside a post. A cluster that stands upright on the ground by itself stays
/// alone, because it may be a person beside another one.
class Clusters {
 public:
  struct Config {
    std::uint32_t small_cells = 100;  ///< Clusters with fewer cells are small.
    float join_m = 0.9F;              ///< Small clusters join others that are nearer than this.
    /// A cluster stands by itself if it begins lower and reaches higher than this above the ground.
    float bottom_m = 0.5F, upright_m = 1.4F;
  };

  Clusters(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory);

  /// Finds the clusters of an image; `height_m` has the height above the ground of each cell.
  /// Real-time safe.
  void find(const frame::RangeImage& image, std::span<const Part> parts,
            std::span<const float> height_m, const Reach& reach) noexcept TERRACUT_NONBLOCKING;

  /// Returns all runs, row by row from column 0 on.
  [[nodiscard]] std::span<const Run> runs() const noexcept { return runs_.first(count_); }
  /// Returns what is known of the cluster of a run that is the first of it.
  [[nodiscard]] const Cluster& cluster(std::uint32_t run) const noexcept { return clusters_[run]; }
  /// Returns the number of a cell's run, by cell; meaningless for cells without a part.
  [[nodiscard]] std::span<const std::uint32_t> run_of_cell() const noexcept { return run_of_; }

 private:
  /// How far small clusters look, in rows upward and in columns to each side.
  static constexpr int kMostRows = 6, kMostColumns = 12;
  static constexpr std::uint32_t kNoBody = 0;

  void cut_row(int row, const frame::PointPlanes& points, std::span<const Part> parts,
               const Reach& reach) noexcept;
  /// True if this run and the last but one before it are one surface behind something nearer.
  [[nodiscard]] bool goes_on_behind(std::uint32_t run, const frame::PointPlanes& points,
                                    const Reach& reach) const noexcept;
  void join_rows(int row, const frame::PointPlanes& points, std::span<const Part> parts,
                 const Reach& reach) noexcept;
  /// Fills in what is known of each cluster before small ones join.
  void sum_up(std::span<const float> height_m) noexcept;
  /// True if a cluster looks for others to join.
  [[nodiscard]] bool is_part(const Cluster& cluster) const noexcept;
  void join_small(const frame::PointPlanes& points, const Reach& reach) noexcept;
  void join_around(const Run& run, int row, const frame::PointPlanes& points,
                   const Reach& reach) noexcept;
  /// Joins a cell's cluster with others that come near it in these columns of a row.
  void join_near(std::uint32_t cell, int row, frame::ColumnRange columns,
                 const frame::PointPlanes& points) noexcept;
  /// Takes notice of two neighbouring cells within reach of each other.
  void touch(std::uint32_t run, std::uint32_t other) noexcept;
  /// Adds up clusters that joined.
  void add_joined() noexcept;
  /// Makes `cluster` of every run final.
  void settle() noexcept;
  [[nodiscard]] std::uint32_t root_of(std::uint32_t run) noexcept;
  void join(std::uint32_t a, std::uint32_t b) noexcept;

  Config config_;
  frame::ImageShape shape_;
  std::uint32_t count_ = 0;
  std::uint32_t row_begin_ = 0;  // first run of the row at work
  std::span<Run> runs_;
  std::span<std::uint32_t> run_of_;
  std::span<std::uint32_t> row_ends_;  // number of runs up to the end of a row
  // By cell: 1 + the first run of its cluster before small ones join, where that is a body's.
  std::span<std::uint32_t> body_of_;
  std::span<Cluster> clusters_;  // by the first run of a cluster
};

}  // namespace terracut::objects
