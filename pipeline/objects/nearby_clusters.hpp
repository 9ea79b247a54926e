// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/objects/clusters.hpp"
#include "pipeline/objects/run.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::objects {

/// Joins small clusters with what lies around them: they may be what is seen of an object through
/// glass or between leaves. A cluster that stands upright on the ground by itself looks for no
/// other, because it may be a person beside another one; and if it is as slim as a person, others
/// join it only where they are beside it.
///
/// The ground is divided into squares as wide as clusters look. Of each cluster it is noted between
/// which coordinates its runs over a square lie; these boxes are compared with those in the same
/// and the adjoining squares. Squares without a small cluster in or around them are left out.
class NearbyClusters {
 public:
  struct Config {
    std::uint32_t small_cells = 100;  ///< Clusters with fewer cells are small.
    float join_m = 0.7F;              ///< Small clusters join others that are nearer than this.
    /// A cluster stands by itself if it begins lower and reaches higher than this above the ground.
    float bottom_m = 0.5F, upright_m = 1.4F;
    /// A cluster by itself and narrower than this is slim; others join it where they are nearer
    /// than `beside_m`, seen from above.
    float slim_m = 1.0F, beside_m = 0.2F;
  };

  /// `most_clusters` and `most_pieces` are how many an image may have.
  NearbyClusters(const Config& config, std::size_t most_clusters, std::size_t most_pieces,
                 memory::FixedMemory& memory);

  /// Finds which clusters belong together. Real-time safe.
  void join(const Clusters& clusters) noexcept TERRACUT_NONBLOCKING;

  /// Returns for each cluster the first of those it belongs together with.
  [[nodiscard]] std::span<const std::uint32_t> first() const noexcept {
    return first_.first(clusters_);
  }
  /// Returns the sum of all clusters that belong together with a first one.
  [[nodiscard]] const Cluster& whole(std::uint32_t first) const noexcept { return whole_[first]; }

 private:
  /// What a cluster does.
  enum class Part : std::uint8_t { kStays, kLooks, kIsSlim };
  /// A cluster's runs over a square.
  struct Piece {
    Extent extent;
    std::uint32_t cluster, next;  ///< `next`: 1 + the next piece in the square; 0: none.
    std::uint32_t square;
  };
  /// Squares on a side. Places that many squares apart share one, and are told apart by their
  /// coordinates.
  static constexpr std::uint32_t kSide = 256, kBits = 64;

  [[nodiscard]] Part part_of(const Cluster& cluster) const noexcept;
  /// Marks the squares in and around which small clusters lie.
  void mark(const Clusters& clusters) noexcept;
  void divide(const Clusters& clusters) noexcept;
  [[nodiscard]] static constexpr std::uint32_t square_at(std::uint32_t x,
                                                         std::uint32_t y) noexcept {
    return y % kSide * kSide + x % kSide;
  }
  [[nodiscard]] bool is_marked(std::uint32_t square) const noexcept {
    return (marked_[square / kBits] >> square % kBits & 1U) != 0;
  }
  /// Adds returns to a cluster's piece in a square; those of the fewest pieces that there is no
  /// room for join nothing.
  void add(std::uint32_t square, std::uint32_t cluster, const Extent& extent) noexcept;
  void join_around(const Piece& piece) noexcept;
  /// Makes first() final, and sums up.
  void settle(std::span<const Cluster> clusters) noexcept;

  Config config_;
  std::uint32_t pieces_used_ = 0;
  std::span<std::uint64_t> marked_;       // a bit for each square
  std::span<std::uint32_t> first_piece_;  // by square; 1 + the piece; 0: none, also between frames
  std::span<Piece> pieces_;
  std::size_t clusters_ = 0;
  std::span<Part> parts_;           // by cluster
  std::span<std::uint32_t> first_;  // by cluster; before settle() one that is no later than itself
  std::span<Cluster> whole_;
};

}  // namespace terracut::objects
