// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
//
// What the min-cut costs: a whole typical frame, its stages one by one, and problems made to be
// hard. Counters are of the last run; they are the same on every machine.
#include <benchmark/benchmark.h>

#include <string>

#include "pipeline/min_cut/greedy_push.hpp"
#include "pipeline/min_cut/grid_cut.hpp"
#include "tests/pipeline/min_cut/adversarial_problems.hpp"

namespace terracut::pipeline {
namespace {

constexpr frame::ImageShape kFrame{64, 2083};
constexpr frame::ImageShape kSixteenThousand{64, 256};

void count(benchmark::State& state, const min_cut::CutReport& report) {
  const auto set = [&](const char* name, auto value) {
    state.counters[name] = static_cast<double>(value);
  };
  set("unknown", report.unknown);
  set("fixed", report.fixed_by_persistency);
  set("components", report.components);
  set("largest", report.largest_component);
  set("coarse", report.coarse_by_budget + report.coarse_by_cap);
  set("ops_persist", report.persistency_ops);
  set("ops_push", report.greedy_push_ops);
  set("ops_bk", report.boykov_kolmogorov_ops);
  set("ops_pr", report.push_relabel_ops);
}

void solve_again_and_again(benchmark::State& state, const test::TestProblem& problem,
                           const min_cut::CutBudget& budget) {
  memory::FixedMemory memory;
  min_cut::GridCut cut(problem.shape, {}, memory);
  const std::vector<frame::Label> coarse = problem.coarse_labelling();
  std::vector<frame::Label> labels = coarse;
  min_cut::CutReport report;
  std::vector<min_cut::Seed> seeds;
  for (auto _ : state) {
    report = cut.solve(problem.view(seeds), problem.costs(), problem.weights(), budget, labels);
    benchmark::DoNotOptimize(report);
  }
  count(state, report);
  state.counters["memory_MB"] = static_cast<double>(memory.total_bytes()) / 1e6;
}

void typical_frame(benchmark::State& state) {
  const auto seed = static_cast<std::uint32_t>(state.range(0));
  solve_again_and_again(state, test::typical_problem(kFrame, seed), {});
}
BENCHMARK(typical_frame)->DenseRange(1, 3)->Unit(benchmark::kMillisecond);

/// Runs the stages up to number range(0); the difference between two lines is one stage.
void typical_frame_up_to_stage(benchmark::State& state) {
  const test::TestProblem problem = test::typical_problem(kFrame, 1);
  constexpr std::uint32_t kNodes = 16'384;
  memory::FixedMemory memory;
  min_cut::Contraction contraction(kFrame, kNodes, memory);
  min_cut::Components components(kNodes, memory);
  min_cut::BoykovKolmogorov boykov_kolmogorov(kNodes, memory);
  const std::vector<frame::Label> labels = problem.coarse_labelling();
  std::vector<min_cut::Seed> seeds;
  constexpr const char* kStages[] = {"seeds copied", "contract", "push", "components", "solve"};
  const auto stage = state.range(0);
  state.SetLabel(kStages[stage]);

  for (auto _ : state) {
    const min_cut::GridProblem view = problem.view(seeds);
    min_cut::CutGraph graph;
    min_cut::OpClock clock({min_cut::CutBudget::kUnlimited});
    if (stage >= 1) {
      benchmark::DoNotOptimize(
          contraction.run(view, problem.costs(), problem.weights(), labels, clock, graph));
    }
    if (stage >= 2) benchmark::DoNotOptimize(min_cut::push_one_hop(graph));
    if (stage >= 3) components.find(graph, contraction.cells(), view.ground_range_m);
    if (stage >= 4) {
      for (std::uint32_t i = 0; i < components.count(); ++i) {
        benchmark::DoNotOptimize(
            boykov_kolmogorov.solve(graph, components[i], clock, min_cut::CutBudget::kUnlimited));
      }
    }
    benchmark::DoNotOptimize(graph.flow);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(typical_frame_up_to_stage)->DenseRange(0, 4)->Unit(benchmark::kMicrosecond);

void register_adversarial() {
  for (const test::AdversarialFamily& family : test::adversarial_families()) {
    benchmark::RegisterBenchmark(("adversarial_16k/" + std::string(family.name)).c_str(),
                                 [&family](benchmark::State& state) {
                                   solve_again_and_again(state, family.make(kSixteenThousand),
                                                         {min_cut::CutBudget::kUnlimited});
                                 })
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace
}  // namespace terracut::pipeline

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  terracut::pipeline::register_adversarial();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
