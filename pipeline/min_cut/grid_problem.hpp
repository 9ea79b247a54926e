// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "firmware_io/frame/range_image.hpp"
#include "pipeline/min_cut/direction.hpp"

namespace terracut::min_cut {

/// What is known of a cell before the min-cut.
enum class Seed : std::uint8_t {
  kNone = 0,      ///< A hole: no return. Cuts the graph.
  kGround = 1,    ///< High-confidence ground: the "background" terminal of paper section III-C.
  kObstacle = 2,  ///< High-confidence obstacle: the "object" terminal.
  kUnknown = 4,   ///< To be labelled. A bit of its own, so that the scan can test 8 cells at once.
};

/// Calls `visit(index)` for each unknown cell, in order. Few cells are, and those lie together:
/// eight are looked at at once.
template <class Visit>
inline void for_each_unknown(std::span<const Seed> seeds, Visit visit) noexcept {
  static_assert(std::endian::native == std::endian::little, "the first cell is in the low byte");
  constexpr std::uint64_t kAnyUnknown =
      0x0101'0101'0101'0101 * static_cast<std::uint64_t>(Seed::kUnknown);
  const auto look_at = [&](std::size_t first, std::size_t count) noexcept {
    std::uint64_t eight = 0;
    std::memcpy(&eight, &seeds[first], count);
    for (std::uint64_t left = eight & kAnyUnknown; left != 0; left &= left - 1) {
      visit(first + static_cast<std::size_t>(std::countr_zero(left)) / 8);
    }
  };
  const std::size_t whole = seeds.size() / 8 * 8;
  for (std::size_t first = 0; first < whole; first += 8) look_at(first, 8);
  if (whole < seeds.size()) look_at(whole, seeds.size() - whole);
}

/// Integer capacity of an energy of 1.0. With 1024 the labels equal those of a solution in double
/// precision (measured on two scenes; 256 already changes some).
inline constexpr int kCapacityScale = 1024;
/// Highest edge weight; larger ones are taken as this. Twice the largest B of Eq. 14, and low
/// enough that a residual capacity, which can reach 2 * weight, fits 16 bits.
inline constexpr int kMaxEdgeWeight = 2 * kCapacityScale;
/// Costs outside [0, kMaxTerminalCost] are clamped to it, in the reported energy too; with 8 edges
/// folded into it the sum stays far inside 32 bits.
inline constexpr std::int32_t kMaxTerminalCost = 1 << 28;

/// The energy of paper Eq. 6-15 in integers scaled by kCapacityScale, as views the caller owns.
///
/// All planes are row-major with `shape.stride()` and at least `shape.cells()` long; padding cells
/// (column >= columns) are never read. `cost_*` and `ground_range_m` are read at unknown cells
/// only.
///
///   E(labels) = sum over unknown p of cost_<label of p>(p)
///             + sum over 8-neighbours p, q with different labels of weight(p, q)
///
/// Pairs of two hard seeds are no part of E: no choice is left for them.
struct GridProblem {
  frame::ImageShape shape;  ///< columns >= 3, rows >= 1.
  std::span<const Seed> seeds;
  std::span<const std::int32_t> cost_ground;    ///< Cost of calling the cell ground.
  std::span<const std::int32_t> cost_obstacle;  ///< Cost of calling the cell obstacle.
  std::span<const float> ground_range_m;        ///< Distance; near cells are solved first.
};

/// Edge weights, called once for every unknown cell:
///   weights(cell, neighbours, out): out[d] = weight of the edge to neighbours[d], in
///   [0, kMaxEdgeWeight], scaled by kCapacityScale.
/// `out[d]` is ignored where neighbours[d] is a hole or leads outside the rows (there
/// neighbours[d] == cell). Must be symmetric, bit for bit: the weight from p to q is the weight
/// from q to p; else the cut is not the minimum. Must not throw.
template <class W>
concept EdgeWeights = std::is_nothrow_invocable_v<const W&, std::uint32_t, const NeighbourCells&,
                                                  std::span<std::uint16_t, kDirections>>;

}  // namespace terracut::min_cut
