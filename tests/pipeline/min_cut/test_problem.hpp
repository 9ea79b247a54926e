// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "pipeline/min_cut/grid_problem.hpp"

namespace terracut::test {

using Random = std::mt19937;
/// Uniform in [low, high]; the same on every standard library.
int uniform(Random& random, int low, int high);

/// A GridProblem that owns its planes, with a table of edge weights.
struct TestProblem {
  explicit TestProblem(frame::ImageShape image_shape);

  frame::ImageShape shape;
  std::vector<min_cut::Seed> seeds;  ///< Holes at first.
  std::vector<std::int32_t> cost_ground, cost_obstacle;
  std::vector<float> ground_range_m;
  std::vector<frame::Label> coarse;
  /// weight[cell][d]; kept symmetric by set_weight().
  std::vector<std::array<std::uint16_t, min_cut::kDirections>> weight;

  [[nodiscard]] std::uint32_t cell(int row,
                                   int column) const;  ///< Column may lie one frame outside.
  void set_weight(int row, int column, int direction, int value);
  /// Calls visit(row, column, cell) for every cell that is not padding.
  template <class Visit>
  void for_each_cell(Visit&& visit) const {
    for (int row = 0; row < shape.rows; ++row) {
      for (int column = 0; column < shape.columns; ++column) visit(row, column, cell(row, column));
    }
  }
  [[nodiscard]] std::uint32_t unknown() const;
  /// The problem to be worked on in `work`, which becomes a copy of the seeds.
  [[nodiscard]] min_cut::GridProblem view(std::vector<min_cut::Seed>& work) const;
  /// E as GridProblem defines it, straight from the definition.
  [[nodiscard]] std::int64_t energy(std::span<const frame::Label> labels) const;
  /// Hard seeds as labels, the coarse label where unknown.
  [[nodiscard]] std::vector<frame::Label> coarse_labelling() const;

  struct Costs {
    const TestProblem* problem;
    min_cut::LabelCosts operator()(std::uint32_t cell) const noexcept {
      return {problem->cost_ground[cell], problem->cost_obstacle[cell]};
    }
  };
  [[nodiscard]] Costs costs() const { return {this}; }

  struct Weights {
    const TestProblem* problem;
    void operator()(std::uint32_t cell, const min_cut::NeighbourCells&,
                    std::span<std::uint16_t, min_cut::kDirections> out) const noexcept {
      const auto& weights = problem->weight[cell];
      for (std::size_t d = 0; d < min_cut::kDirections; ++d) out[d] = weights[d];
    }
  };
  [[nodiscard]] Weights weights() const { return {this}; }
};

/// How random_problem() rolls its dice, in percent where not said otherwise.
struct RandomRecipe {
  int holes = 10, ground_seeds = 15, obstacle_seeds = 15;  ///< The rest is unknown.
  int zero_edges = 15;
  int max_weight = min_cut::kCapacityScale;
  int max_cost = 2 * min_cut::kCapacityScale;
  int zero_costs = 20;
};
TestProblem random_problem(frame::ImageShape shape, const RandomRecipe& recipe, Random& random);

/// A different shape and recipe for every draw: from a handful to some hundreds of cells.
TestProblem any_problem(Random& random);

}  // namespace terracut::test
