// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/baselines/belief_propagation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

namespace terracut::baselines {
namespace {

using StepCost = BeliefPropagation::StepCost;

double cost_of(const StepCost& cost, int from, int to) {
  const int paid = std::max(0, std::abs(from - to) - cost.free_labels);
  return std::min<double>(cost.limit, cost.per_label * static_cast<float>(paid));
}

/// Costs that leave one best labelling: any two sums of thousandths differ.
void fill(BeliefPropagation& field, const BeliefPropagation::Shape& shape, std::mt19937& random,
          std::vector<float>& kept) {
  std::uniform_real_distribution<float> cost(0, 4);
  kept.clear();
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      for (float& entry : field.data_cost(row, column)) kept.push_back(entry = cost(random));
    }
  }
}

/// The sum that the labels found make, on a field that is not cyclic. `between`, `within`: of the
/// neighbours in a column and in a row.
double energy(BeliefPropagation& field, const BeliefPropagation::Shape& shape,
              const std::vector<StepCost>& between, const StepCost& within) {
  double sum = 0;
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      const int here = field.label(row, column);
      sum += static_cast<double>(field.data_cost(row, column)[static_cast<std::size_t>(here)]);
      if (row + 1 < shape.rows) {
        sum += cost_of(between[static_cast<std::size_t>(row)], here, field.label(row + 1, column));
      }
      if (column + 1 < shape.columns) sum += cost_of(within, here, field.label(row, column + 1));
    }
  }
  return sum;
}

/// Viterbi: the least cost of a chain of nodes.
double least_of_chain(const std::vector<float>& data, int nodes, int labels,
                      const std::vector<StepCost>& steps) {
  std::vector<double> best(data.begin(), data.begin() + labels);
  for (int node = 1; node < nodes; ++node) {
    std::vector<double> next(static_cast<std::size_t>(labels));
    for (int to = 0; to < labels; ++to) {
      double least = std::numeric_limits<double>::infinity();
      for (int from = 0; from < labels; ++from) {
        least = std::min(least, best[static_cast<std::size_t>(from)] +
                                    cost_of(steps[static_cast<std::size_t>(node - 1)], from, to));
      }
      next[static_cast<std::size_t>(to)] =
          least + static_cast<double>(data[static_cast<std::size_t>(node * labels + to)]);
    }
    best = next;
  }
  return *std::min_element(best.begin(), best.end());
}

TEST(BeliefPropagation, IsExactOnAChainOfRows) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const BeliefPropagation::Shape shape{12, 1, 9, false};
    memory::FixedMemory memory;
    BeliefPropagation field(shape, memory);
    std::vector<float> data;
    fill(field, shape, random, data);
    std::vector<StepCost> steps;
    for (int row = 0; row + 1 < shape.rows; ++row) {
      steps.push_back({0.25F * static_cast<float>(random() % 8), static_cast<int>(random() % 4),
                       0.5F * static_cast<float>(random() % 9)});
      field.set_step_between_rows(row, steps.back());
    }
    field.run(shape.rows);
    EXPECT_NEAR(energy(field, shape, steps, {}),
                least_of_chain(data, shape.rows, shape.labels, steps), 1e-4);
  }
}

TEST(BeliefPropagation, IsExactOnAChainWithinARow) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const BeliefPropagation::Shape shape{1, 15, 6, false};
    memory::FixedMemory memory;
    BeliefPropagation field(shape, memory);
    std::vector<float> data;
    fill(field, shape, random, data);
    const StepCost step{0.8F, static_cast<int>(random() % 2), 2.5F};
    field.set_step_within_row(0, step);
    field.run(shape.columns);
    const std::vector<StepCost> steps(14, step);
    EXPECT_NEAR(energy(field, shape, {}, step),
                least_of_chain(data, shape.columns, shape.labels, steps), 1e-4);
  }
}

TEST(BeliefPropagation, IsExactWhereCertainNodesCutTheLoops) {
  // Two rows of four, all but the first column certain: what is left is a pair. Compared with the
  // best of all 6561 labellings.
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const BeliefPropagation::Shape shape{2, 4, 3, false};
    memory::FixedMemory memory;
    BeliefPropagation field(shape, memory);
    std::vector<float> data;
    fill(field, shape, random, data);
    for (int column = 1; column < shape.columns; ++column) {
      for (int row = 0; row < shape.rows; ++row) {
        field.data_cost(row, column)[static_cast<std::size_t>(column % 3)] = -100;
        data[static_cast<std::size_t>((row * shape.columns + column) * 3 + column % 3)] = -100;
      }
    }
    const StepCost step{1, 0, 2};
    for (int row = 0; row < shape.rows; ++row) field.set_step_within_row(row, step);
    field.set_step_between_rows(0, step);
    field.run(10);

    double least = std::numeric_limits<double>::infinity();
    for (int code = 0; code < 6561; ++code) {  // 3^8
      int label[2][4], rest = code;
      double sum = 0;
      for (int node = 0; node < 8; ++node, rest /= 3) {
        label[node / 4][node % 4] = rest % 3;
        sum += static_cast<double>(data[static_cast<std::size_t>(node * 3 + rest % 3)]);
      }
      for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 3; ++column) {
          sum += cost_of(step, label[row][column], label[row][column + 1]);
        }
      }
      for (int column = 0; column < 4; ++column) {
        sum += cost_of(step, label[0][column], label[1][column]);
      }
      least = std::min(least, sum);
    }
    EXPECT_NEAR(energy(field, shape, {step}, step), least, 1e-3);
  }
}

TEST(BeliefPropagation, ClosesTheRingWhereItIsCyclic) {
  // One certain node at each side of the seam; the nodes between take over what the near one says.
  for (const bool cyclic : {false, true}) {
    const BeliefPropagation::Shape shape{1, 8, 2, cyclic};
    memory::FixedMemory memory;
    BeliefPropagation field(shape, memory);
    field.set_step_within_row(0, {1, 0, 1});
    field.data_cost(0, 0)[0] = 10;   // wants label 1
    field.data_cost(0, 4)[1] = 10;   // wants label 0
    field.data_cost(0, 7)[1] = 0.5;  // leans to label 0, against its neighbour across the seam
    field.data_cost(0, 6)[0] = 0.6F;
    field.run(8);
    EXPECT_EQ(field.label(0, 0), 1);
    EXPECT_EQ(field.label(0, 4), 0);
    EXPECT_EQ(field.label(0, 7), cyclic ? 1 : 0);
  }
}

TEST(BeliefPropagation, FillsNodesThatKnowNothingFromTheirNeighbours) {
  const BeliefPropagation::Shape shape{9, 9, 16, false};
  memory::FixedMemory memory;
  BeliefPropagation field(shape, memory);
  for (int row = 0; row < shape.rows; ++row) {
    field.set_step_within_row(row, {1, 0, 4});
    if (row + 1 < shape.rows) field.set_step_between_rows(row, {1, 0, 4});
    for (int column = 0; column < shape.columns; ++column) {
      const bool inside = row >= 3 && row < 6 && column >= 3 && column < 6;
      for (int label = 0; label < shape.labels; ++label) {
        field.data_cost(row, column)[static_cast<std::size_t>(label)] =
            inside ? 0.0F : static_cast<float>(std::abs(label - 11));
      }
    }
  }
  field.run(12);
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      EXPECT_EQ(field.label(row, column), 11) << row << ' ' << column;
    }
  }
  EXPECT_EQ(energy(field, shape, std::vector<StepCost>(9, {1, 0, 4}), {1, 0, 4}), 0.0);
}

TEST(BeliefPropagation, KeepsASteepStepWhereBothSidesAreSure) {
  const BeliefPropagation::Shape shape{1, 20, 32, false};
  memory::FixedMemory memory;
  BeliefPropagation field(shape, memory);
  field.set_step_within_row(0, {1, 1, 3});
  for (int column = 0; column < shape.columns; ++column) {
    for (int label = 0; label < shape.labels; ++label) {
      const int wanted = column < 10 ? 4 : 28;
      field.data_cost(0, column)[static_cast<std::size_t>(label)] =
          static_cast<float>(std::min(5, std::abs(label - wanted)));
    }
  }
  field.run(20);
  EXPECT_EQ(field.label(0, 9), 4);
  EXPECT_EQ(field.label(0, 10), 28);
  EXPECT_EQ(energy(field, shape, {}, {1, 1, 3}), 3.0);
}

}  // namespace
}  // namespace terracut::baselines
