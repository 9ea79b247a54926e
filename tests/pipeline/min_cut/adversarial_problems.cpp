// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "adversarial_problems.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace terracut::test {
namespace {

constexpr int kStrong = min_cut::kCapacityScale;

/// Unknown everywhere; weight(random) gives each edge.
template <class Weight>
TestProblem all_unknown(frame::ImageShape shape, Random& random, Weight&& weight) {
  TestProblem problem(shape);
  problem.for_each_cell([&](int row, int column, std::uint32_t p) {
    problem.seeds[p] = min_cut::Seed::kUnknown;
    for (int d = 4; d < min_cut::kDirections; ++d)
      problem.set_weight(row, column, d, weight(random));
  });
  return problem;
}
int any_weight(Random& random) {
  return uniform(random, 1, kStrong);
}
int full_weight(Random&) {
  return kStrong;
}

void give_excess(TestProblem& problem, std::uint32_t p, int excess) {
  problem.cost_ground[p] = std::max(0, excess);
  problem.cost_obstacle[p] = std::max(0, -excess);
}

TestProblem random_terminals_random_weights(frame::ImageShape shape) {
  Random random(101);
  TestProblem problem = all_unknown(shape, random, any_weight);
  problem.for_each_cell([&](int, int, std::uint32_t p) {
    give_excess(problem, p, uniform(random, -2 * kStrong, 2 * kStrong));
  });
  return problem;
}

TestProblem random_terminals_equal_weights(frame::ImageShape shape) {
  Random random(102);
  TestProblem problem = all_unknown(shape, random, full_weight);
  problem.for_each_cell([&](int, int, std::uint32_t p) {
    give_excess(problem, p, uniform(random, -4 * kStrong, 4 * kStrong));
  });
  return problem;
}

TestProblem checkerboard_seeds(frame::ImageShape shape) {
  Random random(103);
  TestProblem problem = all_unknown(shape, random, any_weight);
  problem.for_each_cell([&](int row, int column, std::uint32_t p) {
    if (row % 2 != 0 || column % 2 != 0) return;
    problem.seeds[p] =
        (row / 2 + column / 2) % 2 == 0 ? min_cut::Seed::kGround : min_cut::Seed::kObstacle;
  });
  return problem;
}

TestProblem top_to_bottom(frame::ImageShape shape) {
  Random random(104);
  TestProblem problem = all_unknown(shape, random, any_weight);
  problem.for_each_cell([&](int row, int, std::uint32_t p) {
    if (row == 0) problem.seeds[p] = min_cut::Seed::kGround;
    if (row + 1 == shape.rows) problem.seeds[p] = min_cut::Seed::kObstacle;
  });
  return problem;
}

TestProblem left_to_right(frame::ImageShape shape) {
  Random random(105);
  TestProblem problem = all_unknown(shape, random, any_weight);
  problem.for_each_cell([&](int, int column, std::uint32_t p) {
    if (column == 0) problem.seeds[p] = min_cut::Seed::kGround;
    if (column == shape.columns / 2) problem.seeds[p] = min_cut::Seed::kObstacle;
  });
  return problem;
}

TestProblem sparse_far_seeds(frame::ImageShape shape) {
  Random random(106);
  TestProblem problem = all_unknown(shape, random, any_weight);
  problem.for_each_cell([&](int row, int column, std::uint32_t p) {
    if (row % 16 != 8 || column % 32 != 16) return;
    problem.seeds[p] =
        (row / 16 + column / 32) % 2 == 0 ? min_cut::Seed::kGround : min_cut::Seed::kObstacle;
  });
  return problem;
}

TestProblem equal_weights_sparse_terminals(frame::ImageShape shape) {
  Random random(107);
  TestProblem problem = all_unknown(shape, random, full_weight);
  problem.for_each_cell([&](int, int, std::uint32_t p) {
    if (uniform(random, 0, 19) == 0)
      give_excess(problem, p, uniform(random, 0, 1) == 0 ? -8 * kStrong : 8 * kStrong);
  });
  return problem;
}

/// A corridor, two rows wide, that winds through the image between walls of holes. Sources in its
/// first third, sinks in its last.
TestProblem serpentine(frame::ImageShape shape) {
  Random random(108);
  TestProblem problem = all_unknown(shape, random, any_weight);
  const int bands = (shape.rows + 2) / 3;
  problem.for_each_cell([&](int row, int column, std::uint32_t p) {
    const int band = row / 3;
    const bool gate = band % 2 == 0 ? column == shape.columns - 2 : column == 1;
    const bool side_wall = column == 0 || column == shape.columns - 1;
    if (side_wall || (row % 3 == 2 && !gate)) problem.seeds[p] = min_cut::Seed::kNone;
    if (3 * band < bands) give_excess(problem, p, uniform(random, 0, 40));
    if (3 * band >= 2 * bands) give_excess(problem, p, -uniform(random, 0, 40));
  });
  return problem;
}

/// Strong blocks joined by weak edges, sources and sinks in turn.
TestProblem two_level(frame::ImageShape shape) {
  Random random(109);
  TestProblem problem(shape);
  problem.for_each_cell([&](int row, int column, std::uint32_t p) {
    problem.seeds[p] = min_cut::Seed::kUnknown;
    const auto block = [](int r, int c) { return std::pair{r / 8, c / 8}; };
    for (int d = 4; d < min_cut::kDirections; ++d) {
      const min_cut::CellStep step = min_cut::kCellSteps[static_cast<std::size_t>(d)];
      const bool inside = block(row, column) == block(row + step.rows, column + step.columns);
      problem.set_weight(row, column, d, inside ? kStrong : uniform(random, 1, 64));
    }
    const int sign = (row / 8 + column / 8) % 2 == 0 ? 1 : -1;
    give_excess(problem, p, sign * uniform(random, 0, 60) + uniform(random, -400, 400));
  });
  return problem;
}

constexpr std::array<AdversarialFamily, 9> kFamilies{{
    {"random_terminals_random_weights", random_terminals_random_weights},
    {"random_terminals_equal_weights", random_terminals_equal_weights},
    {"checkerboard_seeds", checkerboard_seeds},
    {"top_to_bottom", top_to_bottom},
    {"left_to_right", left_to_right},
    {"sparse_far_seeds", sparse_far_seeds},
    {"equal_weights_sparse_terminals", equal_weights_sparse_terminals},
    {"serpentine", serpentine},
    {"two_level", two_level},
}};

/// Smooth noise in [-1, 1]: random values on a coarse lattice, cyclic in columns, blended between.
class Noise {
 public:
  Noise(frame::ImageShape shape, int row_step, int column_step, Random& random)
      : row_step_(row_step),
        column_step_(column_step),
        lattice_columns_(shape.columns / column_step) {
    values_.resize(static_cast<std::size_t>((shape.rows / row_step + 2) * lattice_columns_));
    for (float& value : values_) value = static_cast<float>(uniform(random, -1000, 1000)) / 1000.0F;
  }
  [[nodiscard]] float operator()(int row, int column) const {
    const int r = row / row_step_, c = column / column_step_;
    const float fr = static_cast<float>(row % row_step_) / static_cast<float>(row_step_);
    const float fc = static_cast<float>(column % column_step_) / static_cast<float>(column_step_);
    return (1 - fr) * ((1 - fc) * at(r, c) + fc * at(r, c + 1)) +
           fr * ((1 - fc) * at(r + 1, c) + fc * at(r + 1, c + 1));
  }

 private:
  [[nodiscard]] float at(int r, int c) const {
    return values_[static_cast<std::size_t>(r * lattice_columns_ + c % lattice_columns_)];
  }
  int row_step_, column_step_, lattice_columns_;
  std::vector<float> values_;
};

}  // namespace

std::span<const AdversarialFamily> adversarial_families() {
  return kFamilies;
}

TestProblem typical_problem(frame::ImageShape shape, std::uint32_t seed) {
  Random random(seed);
  const Noise objects(shape, 8, 24, random), detail(shape, 3, 6, random);
  TestProblem problem(shape);
  std::vector<float> height(shape.cells());
  problem.for_each_cell([&](int row, int column, std::uint32_t p) {
    const float shape_height = objects(row, column) + 0.35F * detail(row, column);
    height[p] = shape_height + static_cast<float>(uniform(random, -100, 100)) / 1000.0F;
    problem.seeds[p] = shape_height < 0.12F   ? min_cut::Seed::kGround
                       : shape_height > 0.24F ? min_cut::Seed::kObstacle
                                              : min_cut::Seed::kUnknown;
    if (uniform(random, 0, 99) < 12) problem.seeds[p] = min_cut::Seed::kNone;
    give_excess(problem, p,
                static_cast<int>(3200.0F * (height[p] - 0.18F)) + uniform(random, -200, 200));
    problem.ground_range_m[p] = 3.0F + static_cast<float>(row * row) / 50.0F;
    problem.coarse[p] = height[p] > 0.18F ? frame::Label::kObstacle : frame::Label::kGround;
  });
  problem.for_each_cell([&](int row, int column, std::uint32_t p) {
    for (int d = 4; d < min_cut::kDirections; ++d) {
      const min_cut::CellStep step = min_cut::kCellSteps[static_cast<std::size_t>(d)];
      if (row + step.rows >= shape.rows) continue;
      const float difference =
          height[p] - height[problem.cell(row + step.rows, column + step.columns)];
      const float weight = std::exp(-40.0F * difference * difference);
      problem.set_weight(row, column, d,
                         static_cast<int>(static_cast<float>(min_cut::kCapacityScale) * weight));
    }
  });
  return problem;
}

}  // namespace terracut::test
