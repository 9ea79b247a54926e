// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "nearby_clusters.hpp"

#include <algorithm>

namespace terracut::objects {
namespace {

using stage::FourFloats;

/// Counts squares along both axes up to a place, from beyond any return.
struct Steps {
  std::uint32_t x, y;
  Steps(stage::FourFloats at_m, float squares_per_m) noexcept {
    constexpr float kPositive = 1 << 16;
    const auto steps = __builtin_convertvector(at_m * squares_per_m + kPositive, stage::FourInts);
    x = static_cast<std::uint32_t>(steps[0]);
    y = static_cast<std::uint32_t>(steps[1]);
  }
};

}  // namespace

NearbyClusters::NearbyClusters(const Config& config, std::size_t most_clusters,
                               std::size_t most_pieces, memory::FixedMemory& memory)
    : config_(config),
      marked_(memory.take<std::uint64_t>("objects", kSide * kSide / kBits)),
      first_piece_(memory.take<std::uint32_t>("objects", kSide * kSide)),
      pieces_(memory.take<Piece>("objects", most_pieces)),
      parts_(memory.take<Part>("objects", most_clusters)),
      first_(memory.take<std::uint32_t>("objects", most_clusters)),
      whole_(memory.take<Cluster>("objects", most_clusters)) {}

void NearbyClusters::join(const frame::PointPlanes& points, const Clusters& clusters) noexcept {
  const std::span<const Cluster> all = clusters.clusters();
  clusters_ = all.size();
  for (std::uint32_t i = 0; i < clusters_; ++i) {
    first_[i] = i;
    parts_[i] = part_of(all[i]);
  }
  mark(clusters);
  divide(points, clusters);
  const std::span<const Piece> pieces = pieces_.first(pieces_used_);
  for (const Piece& piece : pieces) {
    if (parts_[piece.cluster] == Part::kLooks) join_around(piece);
  }
  for (const Piece& piece : pieces) first_piece_[piece.square] = 0;
  settle(all);
}

NearbyClusters::Part NearbyClusters::part_of(const Cluster& cluster) const noexcept {
  const Extent& extent = cluster.extent;
  const bool stands = extent.bottom_m() < config_.bottom_m && extent.top_m() > config_.upright_m;
  if (!stands) return cluster.cells < config_.small_cells ? Part::kLooks : Part::kStays;
  const FourFloats size_m = extent.most_m - extent.least_m;
  return std::max(size_m[0], size_m[1]) < config_.slim_m ? Part::kIsSlim : Part::kStays;
}

void NearbyClusters::mark(const Clusters& clusters) noexcept {
  std::ranges::fill(marked_, std::uint64_t{0});
  const std::span<const Run> runs = clusters.runs();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (parts_[runs[i].cluster] != Part::kLooks) continue;
    const Steps least(clusters.extents()[i].least_m, 1 / config_.join_m);
    const Steps most(clusters.extents()[i].most_m, 1 / config_.join_m);
    for (std::uint32_t y = least.y - 1; y != most.y + 2; ++y) {
      for (std::uint32_t x = least.x - 1; x != most.x + 2; ++x) {
        const std::uint32_t square = y % kSide * kSide + x % kSide;
        marked_[square / kBits] |= std::uint64_t{1} << square % kBits;
      }
    }
  }
}

void NearbyClusters::settle(std::span<const Cluster> clusters) noexcept {
  for (std::uint32_t i = 0; i < clusters_; ++i) {
    first_[i] = first_[first_[i]];  // an earlier cluster, whose first one is known
    if (first_[i] == i) {
      whole_[i] = clusters[i];
      continue;
    }
    Cluster& whole = whole_[first_[i]];
    whole.cells += clusters[i].cells;
    whole.extent.add(clusters[i].extent);
  }
}

void NearbyClusters::divide(const frame::PointPlanes& points, const Clusters& clusters) noexcept {
  pieces_used_ = 0;
  const auto square_of = [per_m = 1 / config_.join_m](FourFloats at_m) noexcept {
    const Steps steps(at_m, per_m);
    return steps.y % kSide * kSide + steps.x % kSide;
  };
  const std::span<const Run> runs = clusters.runs();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    const Extent& extent = clusters.extents()[i];
    const Steps least(extent.least_m, 1 / config_.join_m);
    const Steps most(extent.most_m, 1 / config_.join_m);
    const std::uint32_t square = least.y % kSide * kSide + least.x % kSide;
    if (least.x == most.x && least.y == most.y) {
      if (is_marked(square)) add(square, run.cluster, extent);
      continue;
    }
    bool is_any_marked = false;
    for (std::uint32_t y = least.y; y != most.y + 1; ++y) {
      for (std::uint32_t x = least.x; x != most.x + 1; ++x) {
        is_any_marked |= is_marked(y % kSide * kSide + x % kSide);
      }
    }
    if (!is_any_marked) continue;
    for (std::uint32_t cell = run.begin; cell < run.end; ++cell) {
      const FourFloats at_m{points.x_m[cell], points.y_m[cell], points.z_m[cell], 0};
      const std::uint32_t of_cell = square_of(at_m);
      if (is_marked(of_cell)) add(of_cell, run.cluster, {at_m, at_m});
    }
  }
}

void NearbyClusters::add(std::uint32_t square, std::uint32_t cluster,
                         const Extent& extent) noexcept {
  for (std::uint32_t i = first_piece_[square]; i != 0; i = pieces_[i - 1].next) {
    if (pieces_[i - 1].cluster == cluster) return pieces_[i - 1].extent.add(extent);
  }
  if (pieces_used_ == pieces_.size()) return;
  pieces_[pieces_used_++] = {extent, cluster, first_piece_[square], square};
  first_piece_[square] = pieces_used_;
}

void NearbyClusters::join_around(const Piece& piece) noexcept {
  const auto [x, y] = Steps(piece.extent.least_m, 1 / config_.join_m);
  for (std::uint32_t other_y = y - 1; other_y != y + 2; ++other_y) {
    for (std::uint32_t other_x = x - 1; other_x != x + 2; ++other_x) {
      std::uint32_t i = first_piece_[other_y % kSide * kSide + other_x % kSide];
      for (; i != 0; i = pieces_[i - 1].next) {
        const Piece& other = pieces_[i - 1];
        if (first_[other.cluster] == first_[piece.cluster]) continue;
        const FourFloats gap_m = greater(greater(other.extent.least_m - piece.extent.most_m,
                                                 piece.extent.least_m - other.extent.most_m),
                                         FourFloats{});
        const FourFloats square_m2 = gap_m * gap_m;
        const float aside_m2 = square_m2[0] + square_m2[1];
        if (aside_m2 + square_m2[2] >= config_.join_m * config_.join_m) continue;
        if (parts_[other.cluster] == Part::kIsSlim &&
            aside_m2 >= config_.beside_m * config_.beside_m) {
          continue;
        }
        const std::uint32_t a = root_of(piece.cluster), b = root_of(other.cluster);
        first_[std::max(a, b)] = std::min(a, b);
      }
    }
  }
}

std::uint32_t NearbyClusters::root_of(std::uint32_t cluster) noexcept {
  while (first_[cluster] != cluster) {
    first_[cluster] = first_[first_[cluster]];
    cluster = first_[cluster];
  }
  return cluster;
}

}  // namespace terracut::objects
