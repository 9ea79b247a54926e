// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "pipeline/min_cut/cut_graph.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// Value of `distance` for a node without a residual path to the sink.
inline constexpr std::uint32_t kNoWayToSink = std::numeric_limits<std::uint32_t>::max();

/// Sets `distance` of every node of the component to the number of residual arcs to the sink (the
/// terminal arc included), or kNoWayToSink. `queue` needs one entry more than there are nodes; its
/// first entries are then the nodes that reach the sink, nearest first. Adds the number of arcs
/// visited to `ops`. Returns how many nodes reach the sink. Real-time safe.
std::uint32_t measure_way_to_sink(CutGraph& graph, std::span<const std::uint32_t> component,
                                  std::span<std::uint32_t> queue,
                                  std::int64_t& ops) noexcept TERRACUT_NONBLOCKING;

/// Labels those nodes of an unfinished component that can be proven from the residual graph: a node
/// that cannot reach the sink is on the source side in an optimum, a node that the source cannot
/// reach is on the sink side (if both: source side). Replacing the labels of these nodes never
/// raises the energy of a labelling. Sets `side`; kFree means that nothing is proven. Returns the
/// number of nodes proven. Real-time safe, linear in the component.
std::uint32_t certify(CutGraph& graph, std::span<const std::uint32_t> component,
                      std::span<std::uint32_t> queue) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::min_cut
