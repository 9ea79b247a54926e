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
      first_piece_(memory.take<std::uint32_t>("objects", kSide * kSide)),
      pieces_(memory.take<Piece>("objects", most_pieces)),
      first_(memory.take<std::uint32_t>("objects", most_clusters)),
      whole_(memory.take<Cluster>("objects", most_clusters)) {}

void NearbyClusters::join(const frame::PointPlanes& points, const Clusters& clusters) noexcept {
  const std::span<const Cluster> all = clusters.clusters();
  clusters_ = all.size();
  for (std::uint32_t i = 0; i < clusters_; ++i) first_[i] = i;
  divide(points, clusters.runs());
  for (const Piece& piece : pieces_.first(pieces_used_)) {
    const Cluster& cluster = all[piece.cluster];
    const bool stands =
        cluster.extent.bottom_m() < config_.bottom_m && cluster.extent.top_m() > config_.upright_m;
    if (cluster.cells < config_.small_cells && !stands) join_around(piece);
  }
  settle(all);
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

void NearbyClusters::divide(const frame::PointPlanes& points, std::span<const Run> runs) noexcept {
  std::ranges::fill(first_piece_, 0U);
  pieces_used_ = 0;
  const auto square_of = [per_m = 1 / config_.join_m](FourFloats at_m) noexcept {
    const Steps steps(at_m, per_m);
    return steps.y % kSide * kSide + steps.x % kSide;
  };
  for (const Run& run : runs) {
    const Extent& extent = run.extent;
    const std::uint32_t square = square_of(extent.least_m);
    if (square == square_of(extent.most_m)) {
      add(square, run.cluster, extent);
      continue;
    }
    for (std::uint32_t cell = run.begin; cell < run.end; ++cell) {
      const FourFloats at_m{points.x_m[cell], points.y_m[cell], points.z_m[cell], 0};
      add(square_of(at_m), run.cluster, {at_m, at_m});
    }
  }
}

void NearbyClusters::add(std::uint32_t square, std::uint32_t cluster,
                         const Extent& extent) noexcept {
  for (std::uint32_t i = first_piece_[square]; i != 0; i = pieces_[i - 1].next) {
    if (pieces_[i - 1].cluster == cluster) return pieces_[i - 1].extent.add(extent);
  }
  if (pieces_used_ == pieces_.size()) return;
  pieces_[pieces_used_++] = {extent, cluster, first_piece_[square]};
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
        if (square_m2[0] + square_m2[1] + square_m2[2] >= config_.join_m * config_.join_m) continue;
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
