// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/min_cut/direction.hpp"
#include "pipeline/min_cut/grid_problem.hpp"

namespace terracut::min_cut {

/// The terminal on whose side a node is. The source is "object", the sink "background".
enum class Side : std::uint8_t {
  kFree = 0,
  kObstacle = 1,  ///< Source side.
  kGround = 2,    ///< Sink side.
};

/// Returns the seed of an unknown cell whose side has been decided.
[[nodiscard]] constexpr Seed decided(Side side) noexcept {
  return side == Side::kObstacle ? Seed::kDecidedObstacle : Seed::kDecidedGround;
}

/// An unknown cell as a node of the residual graph; one cache line.
///
/// For every labelling all solvers keep this sum constant: flow + cost of the cut in the residual
/// graph. So each may stop at any time, and the next one continues from the graph as it is.
struct alignas(64) CutNode {
  std::array<std::uint32_t, kDirections> neighbour;  ///< Node index; valid if `edges` has the bit.
  std::array<std::int16_t, kDirections> residual;  ///< Remaining capacity to it; 0 without an edge.
  std::int32_t excess;     ///< Above 0: capacity left from the source; below 0: to the sink.
  std::uint32_t distance;  ///< To the tree's root (Boykov-Kolmogorov) or the sink (push-relabel).
  std::uint32_t stamp;     ///< Boykov-Kolmogorov: augmentation at which `distance` was valid.
  std::uint8_t edges;      ///< Bit d: there is an edge in direction d to an open node.
  std::uint8_t parent;     ///< Boykov-Kolmogorov: direction of the parent, or kParent...
  Side side;               ///< The tree while solving, the answer afterwards.
  bool queued;             ///< True while in the queue of active nodes.
};
static_assert(sizeof(CutNode) == 64);

/// The graph that remains after hard seeds have become terminal capacities.
struct CutGraph {
  std::span<CutNode> nodes;
  std::int64_t flow = 0;  ///< Flow found so far: energy that no labelling avoids.
};

/// Calls visit(direction) for each bit of `edges`, lowest first.
template <class Visit>
inline void for_each_edge(std::uint8_t edges, Visit&& visit) noexcept {
  for (unsigned left = edges; left != 0; left &= left - 1) visit(std::countr_zero(left));
}

/// Moves `amount` along the arc of `from` in `direction`, which leads to `to`.
inline void push_along(CutNode& from, CutNode& to, int direction, int amount) noexcept {
  std::int16_t& forth = from.residual[static_cast<std::size_t>(direction)];
  std::int16_t& back = to.residual[static_cast<std::size_t>(opposite(direction))];
  forth = static_cast<std::int16_t>(forth - amount);
  back = static_cast<std::int16_t>(back + amount);
}

/// Adds terminal capacity to a node: above 0 from the source, below 0 to the sink. Returns the part
/// that cancels capacity of the opposite terminal: this part is flow.
[[nodiscard]] inline int add_excess(CutNode& node, int amount) noexcept {
  const bool meets = (node.excess > 0) != (amount > 0);
  const int flow = meets ? std::min(std::abs(node.excess), std::abs(amount)) : 0;
  node.excess += amount;
  return flow;
}

}  // namespace terracut::min_cut
