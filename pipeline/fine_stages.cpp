// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/fine_stages.hpp"

#include "pipeline/boundary_term.hpp"

namespace terracut::pipeline {
namespace {

bool has_expired(const CutBudget& budget) noexcept {
  return budget.expired != nullptr && budget.expired(budget.context);
}

}  // namespace

FineStages::FineStages(const SegmenterConfig& config, const calib::RingProfile& profile,
                       ImageShape shape, std::size_t return_capacity, rt::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      seeds_(config.seeds, profile, shape, memory),
      region_(config.region, shape, memory),
      min_cut_(shape, config.min_cut, memory),
      return_labels_(config.returns, return_capacity, memory) {
  if (config.road.enabled) road_surface_.emplace(config.road, shape, memory);
}

SegmentationReport FineStages::refine(const RangeImage& image, CellPlanes& planes,
                                      const CutBudget& budget, StageObserver* observer) noexcept {
  SegmentationReport report;
  const auto done = [observer](Stage stage) noexcept {
    if (observer != nullptr) observer->stage_done(stage);
  };
  if (observer != nullptr) observer->resumed();

  // What is not certain yet is labelled together, by the cheapest cut of the range image.
  report.last_stage = config_.last_stage;
  if (config_.last_stage >= Stage::kMinCut && has_expired(budget)) {
    report.last_stage = Stage::kAdjacentPoints;
  }
  if (report.last_stage >= Stage::kMinCut) {
    seeds_.select(planes);
    region_.evaluate(image, planes, seeds_.seeds());
    done(Stage::kSeeds);
    report.cut = cut(image, planes, budget);
    done(Stage::kMinCut);
    if (report.cut.discarded) report.last_stage = Stage::kAdjacentPoints;
  }

  return_labels_.assign(image, planes);
  if (road_surface_) road_surface_->mark(image, planes, return_labels_.mutable_labels());
  done(Stage::kLabels);

  report.count(return_labels_.labels());
  return report;
}

CutReport FineStages::cut(const RangeImage& image, CellPlanes& planes,
                          const CutBudget& budget) noexcept {
  const GridProblem problem{shape_, seeds_.seeds(), region_.cost_ground(), region_.cost_obstacle(),
                            image.ground_range_m()};
  return min_cut_.solve(problem, BoundaryTerm(config_.boundary, negative_exp_, image), budget,
                        planes.label);
}

}  // namespace terracut::pipeline
