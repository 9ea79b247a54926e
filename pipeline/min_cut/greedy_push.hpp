// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "pipeline/min_cut/cut_graph.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// Sends flow along all paths with a single edge, source - p - q - sink, before any search: this
/// leaves only a third of the augmentations to Boykov-Kolmogorov. Makes one pass in node order and
/// returns the number of arcs visited. Real-time safe.
std::int64_t push_one_hop(CutGraph& graph) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::min_cut
