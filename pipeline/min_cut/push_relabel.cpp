// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/push_relabel.hpp"

#include <algorithm>

#include "pipeline/min_cut/residual_reach.hpp"

namespace terracut::min_cut {
namespace {

/// After lifts have cost this much work, distances are computed exactly again. Such a computation
/// visits each arc once, about 8 operations a node. Four times that was the best interval over the
/// adversarial inputs; without it one of them takes 10 times as long.
constexpr std::int64_t kLiftWorkPerNode = 32;

}  // namespace

PushRelabel::PushRelabel(std::size_t max_nodes, memory::FixedMemory& memory)
    : level_first_(memory.take<std::uint32_t>("min-cut: push-relabel", max_nodes + 2)),
      level_next_(memory.take<std::uint32_t>("min-cut: push-relabel", max_nodes)),
      level_previous_(memory.take<std::uint32_t>("min-cut: push-relabel", max_nodes)),
      active_first_(memory.take<std::uint32_t>("min-cut: push-relabel", max_nodes + 2)),
      active_next_(memory.take<std::uint32_t>("min-cut: push-relabel", max_nodes)),
      queue_(memory.take<std::uint32_t>("min-cut: push-relabel", max_nodes + 1)) {}

bool PushRelabel::solve(CutGraph& graph, std::span<const std::uint32_t> component,
                        OpClock& clock) noexcept {
  nodes_ = graph.nodes;
  flow_ = ops_ = 0;
  const auto lift_work_limit = kLiftWorkPerNode * static_cast<std::int64_t>(component.size());

  relabel_all(component);
  bool finished = true, distances_are_exact = true;
  while (finished) {
    const std::uint32_t index = take_highest_active();
    if (index == kEnd) break;
    discharge(index);
    distances_are_exact = lift_work_ > lift_work_limit;
    if (distances_are_exact) relabel_all(component);
    clock.spend(ops_);
    ops_ = 0;
    finished = !clock.exhausted();
  }
  graph.flow += flow_;

  if (finished) {
    if (!distances_are_exact) measure_way_to_sink(graph, component, queue_, ops_);
    for (const std::uint32_t index : component) {
      CutNode& node = nodes_[index];
      node.side = node.distance == kNoWayToSink ? Side::kObstacle : Side::kGround;
    }
  }
  clock.spend(ops_);
  return finished;
}

void PushRelabel::relabel_all(std::span<const std::uint32_t> component) noexcept {
  const std::size_t levels = component.size() + 2;
  std::fill_n(level_first_.begin(), levels, kEnd);
  std::fill_n(active_first_.begin(), levels, kEnd);
  levels_ = highest_active_ = 0;
  lift_work_ = 0;
  CutGraph graph{nodes_};
  const std::uint32_t reaching = measure_way_to_sink(graph, component, queue_, ops_);
  for (const std::uint32_t index : queue_.first(reaching)) {
    enter_level(index);
    if (nodes_[index].excess > 0) make_active(index);
  }
}

void PushRelabel::enter_level(std::uint32_t index) noexcept {
  const std::uint32_t level = nodes_[index].distance;
  const std::uint32_t next = level_first_[level];
  level_first_[level] = index;
  level_next_[index] = next;
  level_previous_[index] = kEnd;
  if (next != kEnd) level_previous_[next] = index;
  levels_ = std::max(levels_, level);
}

void PushRelabel::leave_level(std::uint32_t index) noexcept {
  const std::uint32_t next = level_next_[index];
  const std::uint32_t previous = level_previous_[index];
  if (next != kEnd) level_previous_[next] = previous;
  (previous != kEnd ? level_next_[previous] : level_first_[nodes_[index].distance]) = next;
}

void PushRelabel::make_active(std::uint32_t index) noexcept {
  const std::uint32_t level = nodes_[index].distance;
  active_next_[index] = active_first_[level];
  active_first_[level] = index;
  highest_active_ = std::max(highest_active_, level);
}

std::uint32_t PushRelabel::take_highest_active() noexcept {
  while (highest_active_ > 0 && active_first_[highest_active_] == kEnd) --highest_active_;
  if (highest_active_ == 0) return kEnd;
  const std::uint32_t index = active_first_[highest_active_];
  active_first_[highest_active_] = active_next_[index];
  return index;
}

void PushRelabel::discharge(std::uint32_t index) noexcept {
  CutNode& p = nodes_[index];
  while (p.distance != kNoWayToSink) {
    std::uint32_t lowest = kNoWayToSink;
    std::int64_t arcs = 0;
    for (unsigned left = p.edges; left != 0; left &= left - 1) {
      const int direction = std::countr_zero(left);
      const auto d = static_cast<std::size_t>(direction);
      ++ops_;
      ++arcs;
      if (p.residual[d] == 0) continue;
      CutNode& q = nodes_[p.neighbour[d]];
      if (q.distance == kNoWayToSink) continue;
      if (q.distance + 1 == p.distance) {
        const int amount = std::min(p.excess, int{p.residual[d]});
        push_along(p, q, direction, amount);
        p.excess -= amount;
        const bool was_active = q.excess > 0;
        flow_ += add_excess(q, amount);
        if (!was_active && q.excess > 0) make_active(p.neighbour[d]);
        if (p.excess == 0) return;
      } else {
        lowest = std::min(lowest, q.distance);
      }
    }
    lift_work_ += arcs;
    lift(index, lowest == kNoWayToSink ? kNoWayToSink : lowest + 1);
  }
}

void PushRelabel::lift(std::uint32_t index, std::uint32_t distance) noexcept {
  const std::uint32_t old = nodes_[index].distance;
  leave_level(index);
  if (level_first_[old] != kEnd) {
    nodes_[index].distance = distance;
    if (distance != kNoWayToSink) enter_level(index);
    return;
  }
  // This leaves a gap: no node is left at the old distance, so no node above it has a path to the
  // sink. No active node is lost, because this one was the highest.
  nodes_[index].distance = kNoWayToSink;
  for (std::uint32_t level = old + 1; level <= levels_; ++level) {
    for (std::uint32_t at = level_first_[level]; at != kEnd; at = level_next_[at]) {
      nodes_[at].distance = kNoWayToSink;
      ++ops_;
    }
    level_first_[level] = kEnd;
  }
  levels_ = old;
}

}  // namespace terracut::min_cut
