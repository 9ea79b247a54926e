// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/min_cut/cut_graph.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// The connected components of the nodes that persistency left undecided. Each component is solved
/// exactly by itself, the nearest first, so that the work can be stopped at any time.
class Components {
 public:
  Components(std::size_t max_nodes, memory::FixedMemory& memory);

  /// Finds all components. Reads `ground_range_m` at `cells[node]`. Real-time safe.
  void find(CutGraph& graph, std::span<const std::uint32_t> cells,
            std::span<const float> ground_range_m) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] std::uint32_t count() const noexcept { return count_; }
  /// Returns the nodes of the i-th component. Components are ordered by the ground range of their
  /// nearest cell, ties by their first node.
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::uint32_t i) const noexcept
      TERRACUT_NONBLOCKING;

 private:
  struct Extent {
    std::uint32_t range_bits;  ///< Range of the nearest cell; as bits it orders like a float.
    std::uint32_t begin, end;  ///< Indices into nodes_; begin advances by each node found.
  };

  std::span<std::uint32_t> nodes_;
  std::span<Extent> extents_;
  std::uint32_t count_ = 0;
};

}  // namespace terracut::min_cut
