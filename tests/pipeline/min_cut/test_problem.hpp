// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "pipeline/label.hpp"
#include "pipeline/min_cut/grid_problem.hpp"

namespace terracut::pipeline::test {

using Random = std::mt19937;
/// Uniform in [low, high]; the same on every standard library.
int uniform(Random& random, int low, int high);

/// A GridProblem that owns its planes, with a table of edge weights.
struct TestProblem {
  explicit TestProblem(ImageShape image_shape);

  ImageShape shape;
  std::vector<Seed> seeds;  ///< Holes at first.
  std::vector<std::int32_t> cost_ground, cost_obstacle;
  std::vector<float> ground_range_m;
  std::vector<Label> coarse;
  /// weight[cell][d]; kept symmetric by set_weight().
  std::vector<std::array<std::uint16_t, kDirections>> weight;

  [[nodiscard]] std::uint32_t cell(int row,
                                   int column) const;  ///< Column may lie one turn outside.
  void set_weight(int row, int column, int direction, int value);
  /// Calls visit(row, column, cell) for every cell that is not padding.
  template <class Visit>
  void for_each_cell(Visit&& visit) const {
    for (int row = 0; row < shape.rows; ++row) {
      for (int column = 0; column < shape.columns; ++column) visit(row, column, cell(row, column));
    }
  }
  [[nodiscard]] std::uint32_t unknown() const;
  [[nodiscard]] GridProblem view() const;
  /// E as GridProblem defines it, straight from the definition.
  [[nodiscard]] std::int64_t energy(std::span<const Label> labels) const;
  /// Hard seeds as labels, the coarse label where unknown.
  [[nodiscard]] std::vector<Label> coarse_labelling() const;

  struct Weights {
    const TestProblem* problem;
    void operator()(std::uint32_t cell, const NeighbourCells&,
                    std::span<std::uint16_t, kDirections> out) const noexcept {
      const auto& weights = problem->weight[cell];
      for (std::size_t d = 0; d < kDirections; ++d) out[d] = weights[d];
    }
  };
  [[nodiscard]] Weights weights() const { return {this}; }
};

/// How random_problem() rolls its dice, in percent where not said otherwise.
struct RandomRecipe {
  int holes = 10, ground_seeds = 15, obstacle_seeds = 15;  ///< The rest is unknown.
  int zero_edges = 15;
  int max_weight = kCapacityScale;
  int max_cost = 2 * kCapacityScale;
  int zero_costs = 20;
};
TestProblem random_problem(ImageShape shape, const RandomRecipe& recipe, Random& random);

/// A different shape and recipe for every draw: from a handful to some hundreds of cells.
TestProblem any_problem(Random& random);

}  // namespace terracut::pipeline::test
