// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "nearby_clusters.hpp"

#include <algorithm>

#include "pipeline/objects/joined_sets.hpp"

namespace terracut::objects {
namespace {

using stage::FourFloats;

/// The squares over which some returns lie, counted along both axes from beyond any return.
struct Squares {
  std::uint32_t least_x, least_y, most_x, most_y;
  Squares(const Extent& extent, float squares_per_m) noexcept {
    constexpr float kPositive = 1 << 16;
    const FourFloats corners_m = __builtin_shufflevector(extent.least_m, extent.most_m, 0, 1, 4, 5);
    const auto steps =
        __builtin_convertvector(corners_m * squares_per_m + kPositive, stage::FourInts);
    least_x = static_cast<std::uint32_t>(steps[0]);
    least_y = static_cast<std::uint32_t>(steps[1]);
    most_x = static_cast<std::uint32_t>(steps[2]);
    most_y = static_cast<std::uint32_t>(steps[3]);
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

void NearbyClusters::join(const Clusters& clusters) noexcept {
  const std::span<const Cluster> all = clusters.clusters();
  clusters_ = all.size();
  for (std::uint32_t i = 0; i < clusters_; ++i) {
    first_[i] = i;
    parts_[i] = part_of(all[i]);
  }
  mark(clusters);
  divide(clusters);
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
    const Squares squares(clusters.extents()[i], 1 / config_.join_m);
    // A run is at most 8 cells long, and goes over fewer squares than a word has bits.
    const std::uint32_t first_x = squares.least_x - 1, count = squares.most_x - squares.least_x + 3;
    const std::uint64_t bits = (std::uint64_t{1} << count) - 1;
    const std::uint32_t shift = first_x % kBits;
    for (std::uint32_t y = squares.least_y - 1; y != squares.most_y + 2; ++y) {
      marked_[square_at(first_x, y) / kBits] |= bits << shift;
      if (shift + count > kBits) {
        marked_[square_at(first_x + kBits, y) / kBits] |= bits >> (kBits - shift);
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

void NearbyClusters::divide(const Clusters& clusters) noexcept {
  pieces_used_ = 0;
  const std::span<const Run> runs = clusters.runs();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Extent& extent = clusters.extents()[i];
    const Squares squares(extent, 1 / config_.join_m);
    for (std::uint32_t y = squares.least_y; y != squares.most_y + 1; ++y) {
      for (std::uint32_t x = squares.least_x; x != squares.most_x + 1; ++x) {
        const std::uint32_t square = square_at(x, y);
        if (is_marked(square)) add(square, runs[i].cluster, extent);
      }
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
  const std::uint32_t x = piece.square % kSide, y = piece.square / kSide;
  for (std::uint32_t other_y = y - 1; other_y != y + 2; ++other_y) {
    for (std::uint32_t other_x = x - 1; other_x != x + 2; ++other_x) {
      std::uint32_t i = first_piece_[square_at(other_x, other_y)];
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
        join_sets(first_, first_of_set(first_, piece.cluster), first_of_set(first_, other.cluster));
      }
    }
  }
}

}  // namespace terracut::objects
