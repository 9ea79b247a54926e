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
    std::array<std::int16_t, min_cut::kDirections> numbers{}, flags{}, kept{}, limited{};
    int sum = 0;
    unsigned nonzero = 0;
    for (std::size_t d = 0; d < min_cut::kDirections; ++d) {
      numbers[d] =
          static_cast<std::int16_t>(uniform(random, 0, 2) == 0 ? 0 : uniform(random, 0, 8191));
      flags[d] = static_cast<std::int16_t>(1 << uniform(random, 0, 3));
      kept[d] = flags[d] == 4 ? numbers[d] : std::int16_t{0};
      limited[d] = std::min(numbers[d], std::int16_t{5000});
      sum += kept[d];
      nonzero |= (kept[d] != 0 ? 1U : 0U) << d;
    }
    const min_cut::EightLanes lanes =
        min_cut::EightLanes::load(numbers).where(min_cut::EightLanes::load(flags), 4);
    std::array<std::int16_t, min_cut::kDirections> stored{};
    lanes.store(stored);
    ASSERT_EQ(stored, kept);
    ASSERT_EQ(lanes.sum(), sum);
    ASSERT_EQ(lanes.nonzero(), nonzero);
    min_cut::EightLanes::load(numbers).at_most(5000).store(stored);
    ASSERT_EQ(stored, limited);
  }
  std::array<std::int16_t, min_cut::kDirections> wide{};
  min_cut::EightLanes::widened(0x04'03'02'01, 0xFF'07'06'05).store(wide);
  EXPECT_EQ(wide, (std::array<std::int16_t, min_cut::kDirections>{1, 2, 3, 4, 5, 6, 7, 255}));
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

TEST(UnknownCells, AreVisitedInOrder) {
  Random random(42);
  for (std::size_t cells = 0; cells < 200; ++cells) {
    std::vector<min_cut::Seed> seeds(cells);
    std::vector<std::size_t> expected, visited;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const bool is_unknown = uniform(random, 0, 99) < (cells % 2 == 0 ? 2 : 50);
      seeds[cell] = is_unknown ? min_cut::Seed::kUnknown : min_cut::Seed::kObstacle;
      if (is_unknown) expected.push_back(cell);
    }
    min_cut::for_each_unknown(seeds, [&](std::size_t cell) { visited.push_back(cell); });
    ASSERT_EQ(visited, expected) << cells;
  }
}

/// A problem taken as far as its components.
struct Contracted {
  explicit Contracted(const TestProblem& problem, std::size_t most_nodes = 1000)
      : contraction(problem.shape, most_nodes, memory), components(most_nodes, memory) {
    min_cut::OpClock clock(kNoLimit);
    result = contraction.run(problem.view(seeds), problem.costs(), problem.weights(),
                             problem.coarse, clock, graph);
    EXPECT_TRUE(result.finished);
  }

  memory::FixedMemory memory;
  std::vector<min_cut::Seed> seeds;
  min_cut::Contraction contraction;
  min_cut::Contraction::Result result;
  min_cut::Components components;
  min_cut::CutGraph graph;
};

/// Whether a node's sums leave its side open: what persistency may not leave behind, or take away.
bool is_open(const min_cut::CutNode& node) {
  int capacity = 0;
  min_cut::for_each_edge(node.edges, [&](int direction) {
    capacity += node.residual[static_cast<std::size_t>(direction)];
  });
  return node.excess < capacity && -node.excess <= capacity;
}

TEST(Contraction, KeepsTheEnergyOfEveryLabellingOfWhatItLeavesOpen) {
  Random random(43);
  std::uint32_t open = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    Contracted contracted(problem);
    const auto cells = contracted.contraction.cells();
    const auto nodes = contracted.graph.nodes;
    std::vector<frame::Label> labels = problem.coarse_labelling();
    for (std::size_t p = 0; p < labels.size(); ++p) {
      if (contracted.seeds[p] == min_cut::Seed::kDecidedGround) labels[p] = frame::Label::kGround;
      if (contracted.seeds[p] == min_cut::Seed::kDecidedObstacle)
        labels[p] = frame::Label::kObstacle;
    }
    const std::int64_t flow_before_pushes = contracted.graph.flow;
    for (const bool pushed : {false, true}) {
      if (pushed) min_cut::push_one_hop(contracted.graph);
      std::int64_t energy = contracted.graph.flow;
      for (std::size_t p = 0; p < nodes.size(); ++p) {
        const min_cut::CutNode& node = nodes[p];
        if (node.side != min_cut::Side::kFree) continue;
        ++open;
        const bool obstacle = labels[cells[p]] == frame::Label::kObstacle;
        energy += obstacle ? std::max(0, -node.excess) : std::max(0, node.excess);
        min_cut::for_each_edge(node.edges, [&](int direction) {
          const frame::Label other =
              labels[cells[node.neighbour[static_cast<std::size_t>(direction)]]];
          if (obstacle && other == frame::Label::kGround)
            energy += node.residual[static_cast<std::size_t>(direction)];
        });
      }
      ASSERT_EQ(energy, problem.energy(labels));
    }
    ASSERT_GE(contracted.graph.flow, flow_before_pushes);
  }
  EXPECT_GT(open, 1000U);
}

TEST(Contraction, LeavesOnlyNodesThatNoSumDecidesAndEdgesBetweenThem) {
  Random random(47);
  std::uint32_t decided = 0, pinned = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    const Contracted contracted(problem, i % 3 == 0 ? 20 : 1000);
    const auto cells = contracted.contraction.cells();
    const auto nodes = contracted.graph.nodes;
    std::uint32_t open = 0;
    for (std::uint32_t p = 0; p < nodes.size(); ++p) {
      const bool is_free = nodes[p].side == min_cut::Side::kFree;
      ASSERT_EQ(contracted.seeds[cells[p]] == min_cut::Seed::kUnknown, is_free);
      if (!is_free) {
        ASSERT_EQ(contracted.seeds[cells[p]], min_cut::decided(nodes[p].side));
        ASSERT_EQ(nodes[p].edges, 0);
        continue;
      }
      ++open;
      ASSERT_TRUE(is_open(nodes[p]));
      min_cut::for_each_edge(nodes[p].edges, [&](int direction) {
        const auto d = static_cast<std::size_t>(direction);
        const auto back = static_cast<std::size_t>(min_cut::opposite(direction));
        const std::uint32_t q = nodes[p].neighbour[d];
        EXPECT_EQ(nodes[q].side, min_cut::Side::kFree);
        EXPECT_EQ(nodes[q].neighbour[back], p);
        EXPECT_EQ(nodes[q].residual[back], nodes[p].residual[d]);
        EXPECT_GT(nodes[p].residual[d], 0);
      });
    }
    const auto& result = contracted.result;
    ASSERT_EQ(result.unknown, problem.unknown());
    ASSERT_EQ(result.unknown, result.decided + result.pinned + open);
    decided += result.decided;
    pinned += result.pinned;
  }
  EXPECT_GT(decided, 1000U);
  EXPECT_GT(pinned, 1000U);
}

TEST(Components, AreConnectedWholeAndNearestFirst) {
  Random random(44);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const TestProblem problem = any_problem(random);
    Contracted contracted(problem);
    const auto nodes = contracted.graph.nodes;
    const auto cells = contracted.contraction.cells();
    contracted.components.find(contracted.graph, cells, problem.ground_range_m);

    std::vector<std::uint32_t> component_of(nodes.size(), 0xFFFFFFFF);
    float last_range_m = -1;
    std::size_t covered = 0;
    for (std::uint32_t c = 0; c < contracted.components.count(); ++c) {
      float range_m = 1e9F;
      for (const std::uint32_t node : contracted.components[c]) {
        ASSERT_EQ(component_of[node], 0xFFFFFFFF) << "in two components";
        component_of[node] = c;
        range_m = std::min(range_m, problem.ground_range_m[cells[node]]);
        ++covered;
      }
      ASSERT_LE(last_range_m, range_m);
      last_range_m = range_m;
    }
    ASSERT_EQ(covered, contracted.result.unknown - contracted.result.decided);

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
    std::vector<std::uint32_t> all(nodes.size()), queue(nodes.size() + 1);
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

TEST(CutReport, CountsTheOperationsOfAllItsSteps) {
  min_cut::CutReport report;
  report.persistency_ops = 1;
  report.greedy_push_ops = 10;
  report.boykov_kolmogorov_ops = 100;
  report.push_relabel_ops = 1000;
  EXPECT_EQ(report.operations(), 1111);
}

}  // namespace
}  // namespace terracut::test
