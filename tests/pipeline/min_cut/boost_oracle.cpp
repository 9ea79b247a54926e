// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "boost_oracle.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/property_map/property_map.hpp>
#include <deque>
#include <limits>

namespace terracut::test {
namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
struct Arc {
  std::int64_t capacity = 0, residual = 0;
  Traits::edge_descriptor reverse;
};
using Graph =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, Arc>;

void add_arcs(Graph& graph, std::size_t from, std::size_t to, std::int64_t forth,
              std::int64_t back) {
  const auto there = boost::add_edge(from, to, graph).first;
  const auto here = boost::add_edge(to, from, graph).first;
  graph[there] = {forth, 0, here};
  graph[here] = {back, 0, there};
}

}  // namespace

Optimum boost_optimum(const TestProblem& problem) {
  const std::size_t source = problem.shape.cells(), sink = source + 1;
  Graph graph(source + 2);
  constexpr std::int64_t kHard = std::numeric_limits<std::int32_t>::max();
  problem.for_each_cell([&](int row, int column, std::uint32_t p) {
    const min_cut::Seed seed = problem.seeds[p];
    if (seed == min_cut::Seed::kNone) return;
    if (seed == min_cut::Seed::kUnknown) {
      add_arcs(graph, source, p, problem.cost_ground[p], 0);
      add_arcs(graph, p, sink, problem.cost_obstacle[p], 0);
    } else if (seed == min_cut::Seed::kObstacle) {
      add_arcs(graph, source, p, kHard, 0);
    } else {
      add_arcs(graph, p, sink, kHard, 0);
    }
    for (int d = 4; d < min_cut::kDirections; ++d) {
      const min_cut::CellStep step = min_cut::kCellSteps[static_cast<std::size_t>(d)];
      if (row + step.rows >= problem.shape.rows) continue;
      const std::uint32_t q = problem.cell(row + step.rows, column + step.columns);
      if (problem.seeds[q] == min_cut::Seed::kNone) continue;
      if (seed != min_cut::Seed::kUnknown && problem.seeds[q] != min_cut::Seed::kUnknown) continue;
      const int weight = problem.weight[p][static_cast<std::size_t>(d)];
      add_arcs(graph, p, q, weight, weight);
    }
  });

  std::vector<int> colour(source + 2), distance(source + 2);
  std::vector<Graph::edge_descriptor> predecessor(source + 2);
  const auto id = boost::get(boost::vertex_index, graph);
  Optimum optimum;
  optimum.energy = boost::boykov_kolmogorov_max_flow(
      graph, boost::get(&Arc::capacity, graph), boost::get(&Arc::residual, graph),
      boost::get(&Arc::reverse, graph), boost::make_iterator_property_map(predecessor.begin(), id),
      boost::make_iterator_property_map(colour.begin(), id),
      boost::make_iterator_property_map(distance.begin(), id), id, source, sink);

  // The largest source side: all but the nodes from which the sink can still be reached.
  std::vector<bool> reaches_sink(source + 2, false);
  std::deque<std::size_t> open{sink};
  reaches_sink[sink] = true;
  while (!open.empty()) {
    const std::size_t at = open.front();
    open.pop_front();
    for (auto [arc, end] = boost::out_edges(at, graph); arc != end; ++arc) {
      const std::size_t other = boost::target(*arc, graph);
      if (reaches_sink[other] || graph[graph[*arc].reverse].residual == 0) continue;
      reaches_sink[other] = true;
      open.push_back(other);
    }
  }
  optimum.labels.assign(problem.shape.cells(), frame::Label::kNone);
  problem.for_each_cell([&](int, int, std::uint32_t p) {
    if (problem.seeds[p] == min_cut::Seed::kNone) return;
    optimum.labels[p] = reaches_sink[p] ? frame::Label::kGround : frame::Label::kObstacle;
  });
  return optimum;
}

Optimum exhaustive_optimum(const TestProblem& problem) {
  std::vector<std::uint32_t> unknown;
  problem.for_each_cell([&](int, int, std::uint32_t p) {
    if (problem.seeds[p] == min_cut::Seed::kUnknown) unknown.push_back(p);
  });
  std::vector<frame::Label> labels = problem.coarse_labelling();
  Optimum best;
  best.energy = std::numeric_limits<std::int64_t>::max();
  int most_obstacles = -1;
  for (std::uint32_t choice = 0; choice < (1U << unknown.size()); ++choice) {
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      labels[unknown[i]] =
          ((choice >> i) & 1U) != 0 ? frame::Label::kObstacle : frame::Label::kGround;
    }
    const std::int64_t energy = problem.energy(labels);
    const int obstacles = std::popcount(choice);
    if (energy > best.energy || (energy == best.energy && obstacles <= most_obstacles)) continue;
    best = {energy, labels};
    most_obstacles = obstacles;
  }
  return best;
}

}  // namespace terracut::test
