// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "nearby_clusters.hpp"

#include <algorithm>

namespace terracut::objects {
namespace {

using stage::FourFloats;

FourFloats least(FourFloats a, FourFloats b) noexcept {
  return a < b ? a : b;
}
FourFloats most(FourFloats a, FourFloats b) noexcept {
  return a > b ? a : b;
}

}  // namespace

NearbyClusters::NearbyClusters(const Config& config, frame::ImageShape shape,
                               memory::FixedMemory& memory)
    : config_(config),
      first_piece_(memory.take<std::uint32_t>("objects", kSide * kSide)),
      pieces_(memory.take<Piece>("objects", shape.cells())),
      first_(memory.take<std::uint32_t>("objects", shape.cells())),
      whole_(memory.take<Cluster>("objects", shape.cells())) {}

void NearbyClusters::join(const frame::PointPlanes& points, const Clusters& clusters) noexcept {
  const std::span<const Cluster> all = clusters.clusters();
  clusters_ = all.size();
  for (std::uint32_t i = 0; i < clusters_; ++i) first_[i] = i;
  divide(points, clusters.runs());
  for (const Piece& piece : pieces_.first(pieces_used_)) {
    const Cluster& cluster = all[piece.cluster];
    const bool stands = cluster.bottom_m < config_.bottom_m && cluster.top_m > config_.upright_m;
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
    whole.bottom_m = std::min(whole.bottom_m, clusters[i].bottom_m);
    whole.top_m = std::max(whole.top_m, clusters[i].top_m);
  }
}

void NearbyClusters::divide(const frame::PointPlanes& points, std::span<const Run> runs) noexcept {
  std::ranges::fill(first_piece_, 0U);
  pieces_used_ = 0;
  const float squares_per_m = 1 / config_.join_m;
  constexpr float kPositive = 1 << 20;
  for (const Run& run : runs) {
    std::uint32_t square = kSide * kSide;
    Piece* piece = nullptr;
    for (std::uint32_t cell = run.begin; cell < run.end; ++cell) {
      const FourFloats point_m{points.x_m[cell], points.y_m[cell], points.z_m[cell], 0};
      const auto x = static_cast<std::uint32_t>(point_m[0] * squares_per_m + kPositive) % kSide;
      const auto y = static_cast<std::uint32_t>(point_m[1] * squares_per_m + kPositive) % kSide;
      if (y * kSide + x != square) {
        square = y * kSide + x;
        piece = &piece_in(square, run.cluster, point_m);
      }
      piece->low_m = least(piece->low_m, point_m);
      piece->high_m = most(piece->high_m, point_m);
    }
  }
}

NearbyClusters::Piece& NearbyClusters::piece_in(std::uint32_t square, std::uint32_t cluster,
                                                FourFloats point_m) noexcept {
  for (std::uint32_t i = first_piece_[square]; i != 0; i = pieces_[i - 1].next) {
    if (pieces_[i - 1].cluster == cluster) return pieces_[i - 1];
  }
  Piece& piece = pieces_[pieces_used_++];
  piece = {point_m, point_m, cluster, first_piece_[square]};
  first_piece_[square] = pieces_used_;
  return piece;
}

void NearbyClusters::join_around(const Piece& piece) noexcept {
  const float squares_per_m = 1 / config_.join_m;
  constexpr float kPositive = 1 << 20;
  const auto x = static_cast<std::uint32_t>(piece.low_m[0] * squares_per_m + kPositive);
  const auto y = static_cast<std::uint32_t>(piece.low_m[1] * squares_per_m + kPositive);
  for (std::uint32_t other_y = y - 1; other_y != y + 2; ++other_y) {
    for (std::uint32_t other_x = x - 1; other_x != x + 2; ++other_x) {
      std::uint32_t i = first_piece_[other_y % kSide * kSide + other_x % kSide];
      for (; i != 0; i = pieces_[i - 1].next) {
        const Piece& other = pieces_[i - 1];
        if (first_[other.cluster] == first_[piece.cluster]) continue;
        const FourFloats gap_m =
            most(most(other.low_m - piece.high_m, piece.low_m - other.high_m), FourFloats{});
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
