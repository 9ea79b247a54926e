// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "pipeline/min_cut/cut_graph.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// `distance` of a node from which no residual path leads to the sink.
inline constexpr std::uint32_t kNoWayToSink = std::numeric_limits<std::uint32_t>::max();

/// Sets `distance` of every node of the component to the number of residual arcs to the sink (the
/// terminal arc included), or kNoWayToSink. `queue` holds an entry per node and one more; on
/// return its first entries are the nodes that reach the sink, nearest first. Adds the arcs visited
/// to `ops`. Real-time safe. Returns how many nodes reach the sink.
std::uint32_t measure_way_to_sink(CutGraph& graph, std::span<const std::uint32_t> component,
                                  std::span<std::uint32_t> queue,
                                  std::int64_t& ops) noexcept TERRACUT_NONBLOCKING;

/// Labels what can be proven of an unfinished component, from the residual graph alone:
/// nodes from which the sink cannot be reached go to the source side in an optimum, nodes that
/// cannot be reached from the source to the sink side (both: source side). All at once, and putting
/// these labels over any labelling never raises its energy. Sets `side`; kFree where nothing is
/// proven. Returns the number of nodes proven. Real-time safe, linear in the component.
std::uint32_t certify(CutGraph& graph, std::span<const std::uint32_t> component,
                      std::span<std::uint32_t> queue) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::min_cut
