// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The parts of the min-cut, each against a plainer way to say the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "pipeline/min_cut/eight_lanes.hpp"
#include "pipeline/min_cut/greedy_push.hpp"
#include "pipeline/min_cut/node_queue.hpp"
#include "pipeline/min_cut/residual_reach.hpp"
#include "solving.hpp"
#include "weight_symmetry.hpp"

namespace terracut::test {
namespace {

TEST(NeighbourCells, LeadBackToWhereTheyCameFrom) {
  const frame::ImageShape shape{4, 7};
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      const auto cell = static_cast<std::uint32_t>(row * shape.stride() + column);
      const min_cut::NeighbourCells around = min_cut::neighbour_cells(shape, row, column);
      for (int d = 0; d < min_cut::kDirections; ++d) {
        const min_cut::CellStep step = min_cut::kCellSteps[static_cast<std::size_t>(d)];
        const std::uint32_t other = around[static_cast<std::size_t>(d)];
        const bool inside = row + step.rows >= 0 && row + step.rows < shape.rows;
        ASSERT_EQ(other != cell, inside);
        if (!inside) continue;
        const int other_row = static_cast<int>(other) / shape.stride();
        const int other_column = static_cast<int>(other) % shape.stride();
        ASSERT_LT(other_column, shape.columns);
        ASSERT_EQ(
            min_cut::neighbour_cells(shape, other_row,
                                     other_column)[static_cast<std::size_t>(min_cut::opposite(d))],
            cell);
      }
    }
  }
}

TEST(EightLanes, AgreeWithLoopsOverEightNumbers) {
  Random random(41);
  for (int i = 0; i < 2000; ++i) {
    std::array<std::int16_t, min_cut::kDirections> numbers{}, flags{}, kept{};
    int sum = 0;
    unsigned nonzero = 0;
    for (std::size_t d = 0; d < min_cut::kDirections; ++d) {
      numbers[d] =
          static_cast<std::int16_t>(uniform(random, 0, 2) == 0 ? 0 : uniform(random, 0, 8191));
      flags[d] = static_cast<std::int16_t>(1 << uniform(random, 0, 3));
      kept[d] = flags[d] == 4 ? numbers[d] : std::int16_t{0};
      sum += kept[d];
      nonzero |= (kept[d] != 0 ? 1U : 0U) << d;
    }
    const min_cut::EightLanes lanes =
        min_cut::EightLanes::load(numbers).where(min_cut::EightLanes::load(flags), 2);
    std::array<std::int16_t, min_cut::kDirections> stored{};
    lanes.store(stored);
    ASSERT_EQ(stored, kept);
    ASSERT_EQ(lanes.sum(), sum);
    ASSERT_EQ(lanes.nonzero(), nonzero);
  }
}

TEST(NodeQueue, KeepsItsOrderAcrossTheEndOfTheRing) {
  memory::FixedMemory memory;
  min_cut::NodeQueue queue("test", 5, memory);
  for (std::uint32_t round = 0; round < 20; ++round) {
    queue.push_back(1);
    queue.push_back(2);
    queue.push_front(0);
    queue.push_back(3);
    queue.push_back(4);
    for (std::uint32_t expected = 0; expected < 5; ++expected)
      ASSERT_EQ(queue.pop_front(), expected);
    ASSERT_TRUE(queue.empty());
    queue.push_back(9);
    ASSERT_EQ(queue.pop_front(), 9U);
  }
}

TEST(OpClock, LooksAtTheClockOnlyNowAndThen) {
  int looks = 0;
  min_cut::OpClock clock({min_cut::CutBudget::kUnlimited,
                          [](void* count) noexcept { return ++*static_cast<int*>(count) > 2; },
                          &looks});
  EXPECT_FALSE(clock.exhausted());
  EXPECT_FALSE(clock.exhausted());
  EXPECT_EQ(looks, 1);
  clock.spend(min_cut::CutBudget::kOpsPerClockLook);
  EXPECT_FALSE(clock.exhausted());
  EXPECT_EQ(looks, 2);
  clock.spend(min_cut::CutBudget::kOpsPerClockLook);
  EXPECT_TRUE(clock.exhausted());
  EXPECT_TRUE(clock.exhausted()) << "once exhausted, always exhausted";
  EXPECT_EQ(looks, 3);
}

TEST(UnknownCells, AreFoundInRowMajorOrder) {
  Random random(42);
  memory::FixedMemory memory;
  for (const int columns : {3, 7, 8, 9, 15, 16, 17, 40}) {
    const TestProblem problem = random_problem({5, columns}, {}, random);
    min_cut::UnknownCells unknown(problem.shape, 1000, memory);
    min_cut::CellList dropped{memory.take<std::uint32_t>("dropped", problem.shape.cells())};
    unknown.find(problem.view(), problem.coarse, dropped);
    std::vector<std::uint32_t> expected;
    problem.for_each_cell([&](int, int, std::uint32_t p) {
      if (problem.seeds[p] == min_cut::Seed::kUnknown) expected.push_back(p);
    });
    ASSERT_TRUE(std::ranges::equal(unknown.cells(), expected)) << columns;
    ASSERT_EQ(dropped.size, 0U);
    for (std::uint32_t node = 0; node < expected.size(); ++node) {
      ASSERT_EQ(unknown.node_of(expected[node]), node);
    }
  }
}

/// A problem taken as far as its components.
struct Contracted {
  explicit Contracted(const TestProblem& problem)
      : unknown(problem.shape, nodes_at_most(problem), memory),
        dropped{memory.take<std::uint32_t>("dropped", problem.shape.cells())},
        components(nodes_at_most(problem), memory) {
    unknown.find(problem.view(), problem.coarse, dropped);
    graph.nodes = memory.take<min_cut::CutNode>("nodes", unknown.cells().size());
    min_cut::OpClock clock(kNoLimit);
    EXPECT_TRUE(min_cut::contract(problem.view(), unknown, problem.weights(), clock, graph));
  }
  static std::uint32_t nodes_at_most(const TestProblem& problem) {
    return static_cast<std::uint32_t>(problem.shape.cells());
  }

  memory::FixedMemory memory;
  min_cut::UnknownCells unknown;
  min_cut::CellList dropped;
  min_cut::Components components;
  min_cut::CutGraph graph;
};

TEST(Contraction, KeepsTheEnergyOfEveryLabelling) {
  Random random(43);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    Contracted contracted(problem);
    std::vector<frame::Label> labels = problem.coarse_labelling();
    const std::int64_t flow_before_pushes = contracted.graph.flow;
    for (const bool pushed : {false, true}) {
      if (pushed) min_cut::push_one_hop(contracted.graph);
      std::int64_t energy = contracted.graph.flow;
      for (std::size_t p = 0; p < contracted.graph.nodes.size(); ++p) {
        const min_cut::CutNode& node = contracted.graph.nodes[p];
        const bool obstacle = labels[contracted.unknown.cells()[p]] == frame::Label::kObstacle;
        energy += obstacle ? std::max(0, -node.excess) : std::max(0, node.excess);
        min_cut::for_each_edge(node.edges, [&](int direction) {
          const auto d = static_cast<std::size_t>(direction);
          const frame::Label other = labels[contracted.unknown.cells()[node.neighbour[d]]];
          if (obstacle && other == frame::Label::kGround) energy += node.residual[d];
        });
      }
      ASSERT_EQ(energy, problem.energy(labels));
    }
    ASSERT_GE(contracted.graph.flow, flow_before_pushes);
  }
}

TEST(Components, AreConnectedWholeAndNearestFirst) {
  Random random(44);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    Contracted contracted(problem);
    const auto nodes = contracted.graph.nodes;
    contracted.components.find(contracted.graph, contracted.unknown.cells(),
                               problem.ground_range_m);

    std::vector<std::uint32_t> component_of(nodes.size(), 0xFFFFFFFF);
    float last_range_m = -1;
    std::size_t covered = 0;
    for (std::uint32_t c = 0; c < contracted.components.count(); ++c) {
      float range_m = 1e9F;
      for (const std::uint32_t node : contracted.components[c]) {
        ASSERT_EQ(component_of[node], 0xFFFFFFFF) << "in two components";
        component_of[node] = c;
        range_m = std::min(range_m, problem.ground_range_m[contracted.unknown.cells()[node]]);
        ++covered;
      }
      ASSERT_LE(last_range_m, range_m);
      last_range_m = range_m;
    }
    ASSERT_EQ(covered, nodes.size());

    // Whole: no edge leaves a component. Connected: labels spread from its first node reach all.
    for (std::uint32_t c = 0; c < contracted.components.count(); ++c) {
      std::vector<std::uint32_t> reached{contracted.components[c][0]};
      std::set<std::uint32_t> seen(reached.begin(), reached.end());
      for (std::size_t next = 0; next < reached.size(); ++next) {
        const min_cut::CutNode& node = nodes[reached[next]];
        min_cut::for_each_edge(node.edges, [&](int direction) {
          const std::uint32_t other = node.neighbour[static_cast<std::size_t>(direction)];
          EXPECT_EQ(component_of[other], c);
          if (seen.insert(other).second) reached.push_back(other);
        });
      }
      ASSERT_EQ(reached.size(), contracted.components[c].size());
    }
  }
}

TEST(Certify, ProvesWhateverHasNoWayToTheSinkOrNoneFromTheSource) {
  Random random(46);
  std::uint32_t proven = 0, unproven = 0;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    Contracted contracted(any_problem(random));
    min_cut::push_one_hop(contracted.graph);
    const auto nodes = contracted.graph.nodes;
    // Ways of any length, by going one arc farther from each node until nothing changes.
    std::vector<bool> to_sink(nodes.size()), from_source(nodes.size());
    for (std::size_t p = 0; p < nodes.size(); ++p) {
      to_sink[p] = nodes[p].excess < 0;
      from_source[p] = nodes[p].excess > 0;
    }
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (std::size_t p = 0; p < nodes.size(); ++p) {
        min_cut::for_each_edge(nodes[p].edges, [&](int direction) {
          const auto d = static_cast<std::size_t>(direction);
          const std::uint32_t q = nodes[p].neighbour[d];
          if (nodes[p].residual[d] == 0) return;
          has_changed |= (to_sink[q] && !to_sink[p]) || (from_source[p] && !from_source[q]);
          to_sink[p] = to_sink[p] || to_sink[q];
          from_source[q] = from_source[q] || from_source[p];
        });
      }
    }
    std::vector<std::uint32_t> all(nodes.size()), queue(nodes.size());
    std::iota(all.begin(), all.end(), 0U);
    const std::uint32_t answered = min_cut::certify(contracted.graph, all, queue);
    std::uint32_t expected = 0;
    for (std::size_t p = 0; p < nodes.size(); ++p) {
      const min_cut::Side side = !to_sink[p]       ? min_cut::Side::kObstacle
                                 : !from_source[p] ? min_cut::Side::kGround
                                                   : min_cut::Side::kFree;
      ASSERT_EQ(nodes[p].side, side) << p;
      expected += side != min_cut::Side::kFree ? 1 : 0;
    }
    ASSERT_EQ(answered, expected);
    proven += expected;
    unproven += static_cast<std::uint32_t>(nodes.size()) - expected;
  }
  EXPECT_GT(proven, 1000U);
  EXPECT_GT(unproven, 1000U);
}

TEST(Persistency, FixesALoneCellAndTheChainItDrags) {
  // One strong cell at the end of a row; each next one follows as its neighbour is decided.
  TestProblem problem({1, 12});
  problem.for_each_cell([&](int, int column, std::uint32_t p) {
    if (column == 11) return;
    problem.seeds[p] = min_cut::Seed::kUnknown;
    problem.cost_ground[p] = column == 0 ? 5000 : 0;
    problem.cost_obstacle[p] = column == 0 ? 0 : 10;
    problem.set_weight(0, column, 4, 1000 - 20 * column);
  });
  const Solution solution = solve(problem);
  EXPECT_EQ(solution.report.unknown, 11U);
  EXPECT_EQ(solution.report.fixed_by_persistency, 11U);
  EXPECT_EQ(solution.report.components, 0U);
  for (std::size_t p = 0; p < 11; ++p) EXPECT_EQ(solution.labels[p], frame::Label::kObstacle);
}

TEST(TestProblem, HasSymmetricWeights) {
  Random random(45);
  const TestProblem problem = any_problem(random);
  expect_symmetric_weights(problem.shape, problem.seeds, problem.weights());
}

}  // namespace
}  // namespace terracut::test
