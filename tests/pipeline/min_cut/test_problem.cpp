// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "test_problem.hpp"

#include <algorithm>

namespace terracut::test {

int uniform(Random& random, int low, int high) {
  const auto choices = static_cast<std::uint32_t>(high - low) + 1U;
  return low + static_cast<int>((static_cast<std::uint64_t>(random()) * choices) >> 32U);
}

TestProblem::TestProblem(frame::ImageShape image_shape)
    : shape(image_shape),
      seeds(shape.cells(), min_cut::Seed::kNone),
      cost_ground(shape.cells(), 0),
      cost_obstacle(shape.cells(), 0),
      ground_range_m(shape.cells(), 0),
      coarse(shape.cells(), frame::Label::kGround),
      weight(shape.cells()) {}

std::uint32_t TestProblem::cell(int row, int column) const {
  const int wrapped = (column + shape.columns) % shape.columns;
  return static_cast<std::uint32_t>(row * shape.stride() + wrapped);
}

void TestProblem::set_weight(int row, int column, int direction, int value) {
  const min_cut::CellStep step = min_cut::kCellSteps[static_cast<std::size_t>(direction)];
  const int other_row = row + step.rows;
  if (other_row < 0 || other_row >= shape.rows) return;
  const auto stored = static_cast<std::uint16_t>(value);
  weight[cell(row, column)][static_cast<std::size_t>(direction)] = stored;
  weight[cell(other_row, column + step.columns)]
        [static_cast<std::size_t>(min_cut::opposite(direction))] = stored;
}

std::uint32_t TestProblem::unknown() const {
  return static_cast<std::uint32_t>(
      std::count(seeds.begin(), seeds.end(), min_cut::Seed::kUnknown));
}

min_cut::GridProblem TestProblem::view(std::vector<min_cut::Seed>& work) const {
  work = seeds;
  return {shape, {0, shape.columns}, work, ground_range_m};
}

std::int64_t TestProblem::energy(std::span<const frame::Label> labels) const {
  std::int64_t sum = 0;
  for_each_cell([&](int row, int column, std::uint32_t p) {
    if (seeds[p] == min_cut::Seed::kNone) return;
    const bool unknown_here = seeds[p] == min_cut::Seed::kUnknown;
    if (unknown_here)
      sum += labels[p] == frame::Label::kObstacle ? cost_obstacle[p] : cost_ground[p];
    for (int d = 4; d < min_cut::kDirections; ++d) {  // each pair once
      const min_cut::CellStep step = min_cut::kCellSteps[static_cast<std::size_t>(d)];
      if (row + step.rows >= shape.rows) continue;
      const std::uint32_t q = cell(row + step.rows, column + step.columns);
      const bool counts = unknown_here || seeds[q] == min_cut::Seed::kUnknown;
      if (seeds[q] == min_cut::Seed::kNone || !counts || labels[p] == labels[q]) continue;
      sum += weight[p][static_cast<std::size_t>(d)];
    }
  });
  return sum;
}

std::vector<frame::Label> TestProblem::coarse_labelling() const {
  std::vector<frame::Label> labels(shape.cells(), frame::Label::kNone);
  for_each_cell([&](int, int, std::uint32_t p) {
    if (seeds[p] == min_cut::Seed::kGround) labels[p] = frame::Label::kGround;
    if (seeds[p] == min_cut::Seed::kObstacle) labels[p] = frame::Label::kObstacle;
    if (seeds[p] == min_cut::Seed::kUnknown) labels[p] = coarse[p];
  });
  return labels;
}

TestProblem random_problem(frame::ImageShape shape, const RandomRecipe& recipe, Random& random) {
  TestProblem problem(shape);
  const auto cost = [&] {
    return uniform(random, 0, 99) < recipe.zero_costs ? 0 : uniform(random, 0, recipe.max_cost);
  };
  problem.for_each_cell([&](int row, int column, std::uint32_t p) {
    const int dice = uniform(random, 0, 99);
    problem.seeds[p] = dice < recipe.holes                         ? min_cut::Seed::kNone
                       : dice < recipe.holes + recipe.ground_seeds ? min_cut::Seed::kGround
                       : dice < recipe.holes + recipe.ground_seeds + recipe.obstacle_seeds
                           ? min_cut::Seed::kObstacle
                           : min_cut::Seed::kUnknown;
    problem.cost_ground[p] = cost();
    problem.cost_obstacle[p] = cost();
    problem.ground_range_m[p] = static_cast<float>(uniform(random, 0, 100));
    problem.coarse[p] =
        uniform(random, 0, 1) == 0 ? frame::Label::kGround : frame::Label::kObstacle;
    for (int d = 4; d < min_cut::kDirections; ++d) {
      const bool zero = uniform(random, 0, 99) < recipe.zero_edges;
      problem.set_weight(row, column, d, zero ? 0 : uniform(random, 1, recipe.max_weight));
    }
  });
  return problem;
}

TestProblem any_problem(Random& random) {
  RandomRecipe recipe;
  recipe.holes = uniform(random, 0, 40);
  recipe.ground_seeds = uniform(random, 0, 25);
  recipe.obstacle_seeds = uniform(random, 0, 25);
  recipe.zero_edges = uniform(random, 0, 60);
  recipe.zero_costs = uniform(random, 0, 95);
  // Small capacities make many cuts equal; large costs let persistency decide nearly everything.
  recipe.max_weight = 1 << uniform(random, 0, 11);
  recipe.max_cost = std::max(1, recipe.max_weight << uniform(random, 0, 6) >> 3);
  return random_problem({uniform(random, 1, 12), uniform(random, 3, 40)}, recipe, random);
}

}  // namespace terracut::test
