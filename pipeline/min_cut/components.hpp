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

/// Connected components of the nodes that persistency left open. Each is solved exactly by itself;
/// solving the nearest first makes the whole an anytime algorithm.
class Components {
 public:
  Components(std::size_t max_nodes, memory::FixedMemory& memory);

  /// Real-time safe. Reads `ground_range_m` at `cells[node]`.
  void find(CutGraph& graph, std::span<const std::uint32_t> cells,
            std::span<const float> ground_range_m) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] std::uint32_t count() const noexcept { return count_; }
  /// Returns the nodes of the i-th component. Components are ordered by the ground range of their
  /// nearest cell, ties by their first node.
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::uint32_t i) const noexcept
      TERRACUT_NONBLOCKING;

 private:
  struct Extent {
    std::uint32_t range_bits;  ///< Range of the nearest cell as bits, which order like floats.
    std::uint32_t begin, end;  ///< In nodes_; begin grows with the first node.
  };

  std::span<std::uint32_t> nodes_;
  std::span<Extent> extents_;
  std::uint32_t count_ = 0;
};

}  // namespace terracut::min_cut
