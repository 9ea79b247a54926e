// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::baselines {

/// Min-sum loopy belief propagation over a grid of nodes with ordered labels, by the fast method of
/// Felzenszwalb and Huttenlocher ("Efficient belief propagation for early vision", IJCV 70(1),
/// 2006): as on a chequerboard, nodes of one colour send while the others receive, and a message
/// takes time linear in the number of labels.
///
/// Seeks labels x that make
///
/// sum data_cost(node, x) + sum step_cost(x - x')
///
/// small, the second sum over neighbours in a row and in a column of the grid. On a chain it is
/// exact after as many iterations as there are nodes; on a grid there is no guarantee.
class BeliefPropagation {
 public:
  static constexpr int kMaxLabels = 128;

  struct Shape {
    int rows = 1;
    int columns = 1;
    int labels = 2;       ///< [2, kMaxLabels]
    bool cyclic = false;  ///< The first column is next to the last one; needs 3 columns.

    [[nodiscard]] std::size_t nodes() const noexcept {
      return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    }
  };

  /// Cost of neighbours whose labels differ by d: min(limit, per_label * max(0, |d| -
  /// free_labels)).
  struct StepCost {
    float per_label = 1;  ///< >= 0
    int free_labels = 0;  ///< >= 0
    float limit = 0;      ///< >= 0; 0: these neighbours do not influence each other.
  };

  BeliefPropagation(const Shape& shape, memory::FixedMemory& memory);

  /// Returns the costs of a node's labels, to be filled before run(). Finite.
  [[nodiscard]] std::span<float> data_cost(int row, int column) noexcept {
    return data_cost_.subspan(node(row, column) * labels(), labels());
  }
  /// Sets the cost between `row` and the next one; row in [0, rows - 1).
  void set_step_between_rows(int row, const StepCost& cost) noexcept {
    between_rows_[static_cast<std::size_t>(row)] = cost;
  }
  /// Sets the cost between neighbours of one row.
  void set_step_within_row(int row, const StepCost& cost) noexcept {
    within_row_[static_cast<std::size_t>(row)] = cost;
  }

  /// Drops earlier messages and runs `iterations` iterations. Real-time safe: O(iterations * nodes
  /// * labels).
  void run(int iterations) noexcept TERRACUT_NONBLOCKING;

  /// Returns the label of least belief; of several adjacent ones the middle one.
  [[nodiscard]] int label(int row, int column) const noexcept { return label_[node(row, column)]; }

 private:
  /// The side from which the receiver gets a message; also the neighbour on that side.
  enum Side : std::uint8_t { kBelow, kAbove, kLeft, kRight, kSides };
  /// Values of all labels for the four sides, label by label: a processor runs four independent
  /// chains of additions in parallel.
  using FourCosts = std::array<float, static_cast<std::size_t>(kMaxLabels) * kSides>;

  [[nodiscard]] std::size_t node(int row, int column) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(shape_.columns) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] std::size_t labels() const noexcept {
    return static_cast<std::size_t>(shape_.labels);
  }
  void add_up(std::size_t node, std::span<float> belief) const noexcept;
  void send_all(int row, int column) noexcept;
  void deliver(const FourCosts& costs, Side to, float limit, std::size_t neighbour) noexcept;
  [[nodiscard]] int least_label(std::span<const float> belief) const noexcept;

  Shape shape_;
  std::span<float> data_cost_;  // node by node
  std::span<float> message_;    // [node][label][side]
  std::span<StepCost> between_rows_, within_row_;
  std::span<std::uint8_t> label_;
};

}  // namespace terracut::baselines
