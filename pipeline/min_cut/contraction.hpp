// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/min_cut/cut_graph.hpp"
#include "pipeline/min_cut/eight_lanes.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// Builds the graph of the unknown cells of a window, in one pass in row-major order.
///
/// An edge to a hard seed is cut exactly when the cell gets the other label. So its weight is added
/// to the cost of that label, and hard seeds need no nodes; this is exact.
///
/// Persistency: a cell whose terminal capacity outweighs all its edges together takes that
/// terminal's label, whatever its neighbours get. Such a cell becomes a hard seed at once: later
/// cells see it as a seed, and earlier nodes beside it are updated, which may decide them in turn,
/// until nothing changes. On real frames two of three unknown cells are decided this way, most
/// without ever being a node. A tie goes to obstacle, as grid_cut.hpp promises.
class Contraction {
 public:
  Contraction(const frame::ImageShape& shape, std::size_t max_nodes, memory::FixedMemory& memory);

  struct Result {
    std::uint32_t unknown = 0;  ///< Unknown cells seen.
    std::uint32_t decided = 0;  ///< Unknown cells decided by persistency.
    std::uint32_t pinned = 0;   ///< Unknown cells left at their coarse label for lack of nodes.
    std::int64_t ops = 0;       ///< Edges from decided cells to nodes.
    bool finished = false;
  };
  /// Decides each unknown cell of `problem.seeds`, or makes it a node of `graph` and leaves its
  /// seed kUnknown; when all nodes are in use, pins the cell to its label in `coarse`. If the
  /// caller's clock expires, `finished` is false and the graph is useless. Real-time safe.
  template <RegionCosts Costs, EdgeWeights Weights>
  [[nodiscard]] Result run(const GridProblem& problem, const Costs& costs, const Weights& weights,
                           std::span<const frame::Label> coarse, OpClock& clock,
                           CutGraph& graph) noexcept;

  /// Returns the cell of each node. A node that was decided later has a side but no edges.
  [[nodiscard]] std::span<const std::uint32_t> cells() const noexcept {
    return cells_.first(size_);
  }

 private:
  /// The weights of a cell's edges to undecided neighbours, and its excess, as in CutNode.
  struct OpenEnds {
    EightLanes weights;
    std::int32_t excess;
  };

  void begin(const GridProblem& problem, OpClock& clock) noexcept TERRACUT_NONBLOCKING;
  void begin_row(int row) noexcept TERRACUT_NONBLOCKING;
  /// Counts one piece of work, and reads the clock once in kNodesPerClockLook calls. Returns false
  /// once the clock has expired.
  [[nodiscard]] bool has_time() noexcept {
    if (work_++ % CutBudget::kNodesPerClockLook == 0 && clock_->expired()) is_stopped_ = true;
    return !is_stopped_;
  }
  template <class Costs, class Weights>
  void take_cell(const Costs& costs, const Weights& weights, std::uint32_t cell, int column,
                 const NeighbourCells& around, frame::Label coarse) noexcept;
  /// Does the work of take_cell() for a cell at an edge of the image. It is compiled separately,
  /// because few cells lie there.
  template <class Costs, class Weights>
  [[gnu::noinline]] void take_cell_at_edge(const Costs& costs, const Weights& weights,
                                           std::uint32_t cell, int column,
                                           const NeighbourCells& around,
                                           frame::Label coarse) noexcept {
    take_cell(costs, weights, cell, column, around, coarse);
  }
  /// Returns the neighbours' seeds, one per lane. Three loads suffice for a cell at no edge of the
  /// image.
  [[nodiscard]] EightLanes seeds_around(const NeighbourCells& around) const noexcept;
  [[nodiscard]] static Side persistent_side(std::int32_t excess, int capacity) noexcept {
    return excess >= capacity ? Side::kObstacle : -excess > capacity ? Side::kGround : Side::kFree;
  }
  void add_node(std::uint32_t cell, int column, const OpenEnds& ends) noexcept;
  /// Updates the nodes of earlier cells beside a cell in `column` that has just been decided.
  void tell_nodes_before(int column, unsigned edges, Side side) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] std::uint32_t node_before(int column, int direction) const noexcept;
  /// Returns the directions to neighbours that come before the cell in `column`.
  [[nodiscard]] unsigned directions_before(int column) const noexcept {
    return column == 0 ? 0b00111U : column + 1 == columns_ ? 0b11111U : 0b01111U;
  }

  int columns_, rows_;
  std::span<CutNode> nodes_;
  std::span<std::uint32_t> cells_;     // cell of each node
  std::span<std::uint32_t> worklist_;  // decided nodes whose neighbours must be told
  std::array<std::span<std::uint32_t>, 2> node_in_row_;  // by column, for even and odd rows

  // State of the problem being solved.
  std::span<Seed> seeds_;
  OpClock* clock_ = nullptr;
  std::uint32_t size_ = 0;
  std::uint32_t work_ = 0;
  bool is_stopped_ = false;
  std::int64_t flow_ = 0;
  Result result_;
  // State of the row being processed.
  std::span<std::uint32_t> here_, below_;  // node of each column, in this row and in the row below
  EightLanes inside_;                      // all bits set for neighbours in the image
};

template <RegionCosts Costs, EdgeWeights Weights>
[[gnu::always_inline]] inline Contraction::Result Contraction::run(
    const GridProblem& problem, const Costs& costs, const Weights& weights,
    std::span<const frame::Label> coarse, OpClock& clock, CutGraph& graph) noexcept {
  begin(problem, clock);
  const frame::ImageShape& shape = problem.shape;
  const auto stride = static_cast<std::uint32_t>(shape.stride());
  for (int row = 0; row < shape.rows; ++row) {
    begin_row(row);
    const bool has_rows_around = row > 0 && row + 1 < shape.rows;
    const std::uint32_t first = static_cast<std::uint32_t>(row) * stride;
    problem.window.for_each_range(
        columns_, [&](frame::ColumnRange columns) __attribute__((always_inline)) {
          const std::uint32_t begin = first + static_cast<std::uint32_t>(columns.begin);
          for_each_unknown(problem.seeds.subspan(begin, columns.size()),
                           [&](std::size_t index) __attribute__((always_inline)) {
                             if (!has_time()) return;
                             const int column = columns.begin + static_cast<int>(index);
                             const std::uint32_t cell = begin + static_cast<std::uint32_t>(index);
                             if (has_rows_around && column > 0 && column + 1 < columns_)
                                 [[likely]] {
                               take_cell(costs, weights, cell, column,
                                         neighbours_inside(cell, stride), coarse[cell]);
                             } else {
                               take_cell_at_edge(costs, weights, cell, column,
                                                 neighbour_cells(shape, row, column), coarse[cell]);
                             }
                           });
        });
    if (is_stopped_) break;
  }
  graph.nodes = nodes_.first(size_);
  graph.flow = flow_;
  result_.finished = !is_stopped_;
  return result_;
}

template <class Costs, class Weights>
[[gnu::always_inline]] inline void Contraction::take_cell(const Costs& costs,
                                                          const Weights& weights,
                                                          std::uint32_t cell, int column,
                                                          const NeighbourCells& around,
                                                          frame::Label coarse) noexcept {
  std::array<std::uint16_t, kDirections> given;
  weights(cell, around, std::span<std::uint16_t, kDirections>(given));
  const EightLanes weight = EightLanes::load(given).at_most(kMaxEdgeWeight);
  const EightLanes seed = seeds_around(around);
  const auto bit = [](Seed value) { return static_cast<std::int16_t>(value); };
  const EightLanes open = weight.where(seed, bit(Seed::kUnknown));
  const LabelCosts cost = costs(cell);
  const auto clamped = [](std::int32_t any) { return std::clamp(any, 0, kMaxTerminalCost); };
  const EightLanes to_ground = weight.where(seed, bit(Seed::kGround));
  const EightLanes to_obstacle = weight.where(seed, bit(Seed::kObstacle));
  const std::int32_t cost_ground = clamped(cost.ground) + to_obstacle.sum();
  const std::int32_t cost_obstacle = clamped(cost.obstacle) + to_ground.sum();
  const std::int32_t excess = cost_ground - cost_obstacle;

  ++result_.unknown;
  Side side = persistent_side(excess, open.sum());
  if (side == Side::kFree && size_ < nodes_.size()) {
    flow_ += std::min(cost_ground, cost_obstacle);
    add_node(cell, column, {open, excess});
    return;
  }
  if (side != Side::kFree) {
    flow_ += std::min(cost_ground, cost_obstacle);
    seeds_[cell] = decided(side);
    ++result_.decided;
  } else {
    // A cell with its coarse label counts as a hard seed: its own cost and its cost against hard
    // seeds are constants, which the energy leaves out.
    const bool is_obstacle = coarse == frame::Label::kObstacle;
    flow_ += (is_obstacle ? to_ground : to_obstacle).where(seed, bit(Seed::kDecided)).sum();
    seeds_[cell] = is_obstacle ? Seed::kPinnedObstacle : Seed::kPinnedGround;
    side = is_obstacle ? Side::kObstacle : Side::kGround;
    ++result_.pinned;
  }
  const unsigned edges = open.nonzero() & directions_before(column);
  if (edges != 0) tell_nodes_before(column, edges, side);
}

inline EightLanes Contraction::seeds_around(const NeighbourCells& around) const noexcept {
  if (are_next_to_each_other(around)) [[likely]] {
    std::uint32_t below, beside, above;
    std::memcpy(&below, &seeds_[around[0]], sizeof(below));
    std::memcpy(&beside, &seeds_[around[3]], sizeof(beside));
    std::memcpy(&above, &seeds_[around[5] - 1], sizeof(above));
    return EightLanes::widened((below & 0xFF'FFFFU) | beside << 24U,
                               (beside >> 16U & 0xFFU) | (above & 0xFFFF'FF00U));
  }
  std::array<std::uint32_t, 2> halves{};
  for (std::size_t d = 0; d < around.size(); ++d) {
    halves[d / 4] |= static_cast<std::uint32_t>(seeds_[around[d]]) << (8 * (d % 4));
  }
  EightLanes seeds = EightLanes::widened(halves[0], halves[1]);
  seeds.lanes &= inside_.lanes;
  return seeds;
}

inline std::uint32_t Contraction::node_before(int column, int direction) const noexcept {
  const int beside = column + kCellSteps[static_cast<std::size_t>(direction)].columns;
  const int wrapped = beside < 0 ? columns_ - 1 : beside == columns_ ? 0 : beside;
  return (direction < 3 ? below_ : here_)[static_cast<std::size_t>(wrapped)];
}

inline void Contraction::add_node(std::uint32_t cell, int column, const OpenEnds& ends) noexcept {
  const std::uint32_t index = size_++;
  cells_[index] = cell;
  here_[static_cast<std::size_t>(column)] = index;
  CutNode& node = nodes_[index];
  ends.weights.store(node.residual);
  node.neighbour.fill(index);  // corrected when the later neighbour becomes a node
  node.excess = ends.excess;
  node.edges = ends.weights.nonzero();
  node.side = Side::kFree;
  const unsigned before = node.edges & directions_before(column);
  for_each_edge(static_cast<std::uint8_t>(before), [&](int direction) {
    const std::uint32_t other = node_before(column, direction);
    node.neighbour[static_cast<std::size_t>(direction)] = other;
    nodes_[other].neighbour[static_cast<std::size_t>(opposite(direction))] = index;
  });
}

}  // namespace terracut::min_cut
