// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/boykov_kolmogorov.hpp"

#include <algorithm>
#include <limits>

namespace terracut::min_cut {

BoykovKolmogorov::BoykovKolmogorov(std::size_t max_nodes, memory::FixedMemory& memory)
    : active_("min-cut: work lists", max_nodes, memory),
      orphans_("min-cut: work lists", max_nodes, memory) {}

bool BoykovKolmogorov::solve(CutGraph& graph, std::span<const std::uint32_t> component,
                             OpClock& clock, std::int64_t ops_limit) noexcept {
  nodes_ = graph.nodes;
  time_ = 0;
  ops_ = flow_ = 0;
  const auto out_of_budget = [&] {
    clock.spend(ops_);
    ops_ = 0;
    return clock.exhausted() || clock.ops() >= ops_limit;
  };

  plant(component);
  bool finished = true;
  while (finished && !active_.empty()) {
    const std::uint32_t index = active_.pop_front();
    node(index).queued = false;
    while (node(index).side != Side::kFree) {
      const Bridge bridge = grow(index);
      if (bridge.direction < 0) break;
      augment(bridge);
      while (finished && !orphans_.empty()) {
        adopt(orphans_.pop_front());
        finished = !out_of_budget();
      }
      if (!finished) break;
    }
    if (finished && out_of_budget()) finished = active_.empty();
  }
  graph.flow += flow_;

  if (finished) {
    for (const std::uint32_t index : component) {
      CutNode& n = node(index);
      if (n.side == Side::kFree) n.side = Side::kObstacle;
    }
  }
  return finished;
}

void BoykovKolmogorov::plant(std::span<const std::uint32_t> component) noexcept {
  active_.clear();
  orphans_.clear();
  for (const std::uint32_t index : component) {
    CutNode& n = node(index);
    n.queued = false;
    n.stamp = 0;
    n.distance = 1;
    n.parent = n.excess == 0 ? kParentNone : kParentTerminal;
    n.side = n.excess > 0 ? Side::kObstacle : n.excess < 0 ? Side::kGround : Side::kFree;
    if (n.side != Side::kFree) activate(index);
  }
}

int BoykovKolmogorov::tree_capacity(const CutNode& parent, const CutNode& child,
                                    int child_to_parent) noexcept {
  return child.side == Side::kObstacle
             ? parent.residual[static_cast<std::size_t>(opposite(child_to_parent))]
             : child.residual[static_cast<std::size_t>(child_to_parent)];
}

void BoykovKolmogorov::activate(std::uint32_t index) noexcept {
  if (node(index).queued) return;
  node(index).queued = true;
  active_.push_back(index);
}

BoykovKolmogorov::Bridge BoykovKolmogorov::grow(std::uint32_t index) noexcept {
  CutNode& p = node(index);
  const bool from_source = p.side == Side::kObstacle;
  for (unsigned left = p.edges; left != 0; left &= left - 1) {
    const int direction = std::countr_zero(left);
    const auto d = static_cast<std::size_t>(direction);
    const auto back = static_cast<std::size_t>(opposite(direction));
    CutNode& q = node(p.neighbour[d]);
    ++ops_;
    if ((from_source ? p.residual[d] : q.residual[back]) == 0) continue;
    if (q.side == Side::kFree) {
      q.side = p.side;
      q.parent = static_cast<std::uint8_t>(back);
      q.stamp = p.stamp;
      q.distance = p.distance + 1;
      activate(p.neighbour[d]);
    } else if (q.side != p.side) {
      return from_source ? Bridge{index, direction}
                         : Bridge{p.neighbour[d], static_cast<int>(back)};
    } else if (q.stamp <= p.stamp && q.distance > p.distance + 1) {
      q.parent = static_cast<std::uint8_t>(back);  // the path over p is shorter
      q.stamp = p.stamp;
      q.distance = p.distance + 1;
    }
  }
  return {index, -1};
}

void BoykovKolmogorov::augment(const Bridge& bridge) noexcept {
  ++time_;
  CutNode& source_leaf = node(bridge.from);
  const auto d = static_cast<std::size_t>(bridge.direction);
  const std::uint32_t sink_leaf_index = source_leaf.neighbour[d];
  int bottleneck = source_leaf.residual[d];
  for (std::uint32_t leaf : {bridge.from, sink_leaf_index}) {
    while (node(leaf).parent != kParentTerminal) {
      const CutNode& child = node(leaf);
      leaf = child.neighbour[child.parent];
      bottleneck = std::min(bottleneck, tree_capacity(node(leaf), child, child.parent));
      ++ops_;
    }
    bottleneck = std::min(bottleneck, std::abs(node(leaf).excess));
  }

  push_along(source_leaf, node(sink_leaf_index), bridge.direction, bottleneck);
  for (std::uint32_t leaf : {bridge.from, sink_leaf_index}) {
    while (node(leaf).parent != kParentTerminal) {
      CutNode& child = node(leaf);
      const std::uint32_t parent_index = child.neighbour[child.parent];
      CutNode& parent = node(parent_index);
      if (child.side == Side::kObstacle) {
        push_along(parent, child, opposite(child.parent), bottleneck);
      } else {
        push_along(child, parent, child.parent, bottleneck);
      }
      if (tree_capacity(parent, child, child.parent) == 0) cut_off(leaf);
      leaf = parent_index;
      ++ops_;
    }
    CutNode& root = node(leaf);
    root.excess += root.side == Side::kObstacle ? -bottleneck : bottleneck;
    if (root.excess == 0) cut_off(leaf);
  }
  flow_ += bottleneck;
}

void BoykovKolmogorov::cut_off(std::uint32_t index) noexcept {
  node(index).parent = kParentNone;
  orphans_.push_front(index);  // orphans nearest to the root come first
}

std::uint32_t BoykovKolmogorov::origin_distance(std::uint32_t index) noexcept {
  std::uint32_t steps = 0;
  std::uint32_t at = index;
  while (node(at).stamp != time_) {
    const CutNode& n = node(at);
    ++ops_;
    if (n.parent == kParentNone) return 0;
    if (n.parent == kParentTerminal) {
      node(at).stamp = time_;
      node(at).distance = 1;
      break;
    }
    ++steps;
    at = n.neighbour[n.parent];
  }
  const std::uint32_t distance = steps + node(at).distance;
  // Stores the distances of the nodes on the way: they stay valid until the next augmentation, so
  // the next search stops at these nodes.
  std::uint32_t known = distance;
  for (at = index; node(at).stamp != time_; at = node(at).neighbour[node(at).parent]) {
    node(at).stamp = time_;
    node(at).distance = known--;
  }
  return distance;
}

void BoykovKolmogorov::adopt(std::uint32_t orphan) noexcept {
  CutNode& p = node(orphan);
  std::uint32_t nearest = std::numeric_limits<std::uint32_t>::max();
  std::uint8_t parent = kParentNone;
  for_each_edge(p.edges, [&](int direction) {
    const std::uint32_t other = p.neighbour[static_cast<std::size_t>(direction)];
    const CutNode& q = node(other);
    ++ops_;
    if (q.side != p.side || tree_capacity(q, p, direction) == 0) return;
    const std::uint32_t distance = origin_distance(other);
    if (distance == 0 || distance >= nearest) return;
    nearest = distance;
    parent = static_cast<std::uint8_t>(direction);
  });
  if (parent != kParentNone) {
    p.parent = parent;
    p.stamp = time_;
    p.distance = nearest + 1;
    return;
  }

  for_each_edge(p.edges, [&](int direction) {
    const std::uint32_t other = p.neighbour[static_cast<std::size_t>(direction)];
    CutNode& q = node(other);
    ++ops_;
    if (q.side != p.side) return;
    if (tree_capacity(q, p, direction) > 0) activate(other);
    if (q.parent == opposite(direction)) {
      q.parent = kParentNone;
      orphans_.push_back(other);
    }
  });
  p.side = Side::kFree;
}

}  // namespace terracut::min_cut
