// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/min_cut/cut_graph.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// Fixes every node whose terminal capacity outweighs all its edges together: whatever its
/// neighbours get, it is not worth cutting it from its terminal. A fixed node acts on its
/// neighbours like a hard seed, which may fix them in turn, until nothing changes. On real frames 7
/// of 10 nodes go this way.
///
/// Ties go to obstacle, so that the answer stays the one described in grid_cut.hpp.
/// Requires untouched capacities: residual of both arcs of an edge equal.
class Persistency {
 public:
  Persistency(std::size_t max_nodes, memory::FixedMemory& memory);

  struct Result {
    std::uint32_t fixed = 0;
    std::int64_t ops = 0;
    bool finished = false;
  };
  /// Sets `side` of the fixed nodes and takes their edges out of the graph. Where the caller's
  /// clock expires first it is not finished, and the graph is of no use. Real-time safe.
  [[nodiscard]] Result fix(CutGraph& graph, OpClock& clock) noexcept TERRACUT_NONBLOCKING;

 private:
  /// Decides `node` if that can be done already; appends it to the worklist then.
  void decide(CutNode& node, std::uint32_t index) noexcept;

  std::span<std::uint32_t> worklist_;
  std::uint32_t worklist_size_ = 0;
};

}  // namespace terracut::min_cut
