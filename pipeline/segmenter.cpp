// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/segmenter.hpp"

#include "pipeline/boundary_term.hpp"

namespace terracut::pipeline {
namespace {

bool has_expired(const CutBudget& budget) noexcept {
  return budget.expired != nullptr && budget.expired(budget.context);
}

}  // namespace

Segmenter::Segmenter(const SegmenterConfig& config, const calib::RingProfile& profile,
                     ImageShape shape, std::size_t return_capacity, rt::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      planes_(shape, memory),
      elevation_map_(config.elevation_map, profile, shape, memory),
      adjacent_points_(config.adjacent_points, profile, shape, memory),
      seeds_(config.seeds, profile, shape, memory),
      region_(config.region, shape, memory),
      min_cut_(shape, config.min_cut, memory),
      return_labels_(config.returns, return_capacity, memory) {}

SegmentationReport Segmenter::segment(const RangeImage& image, const CutBudget& budget,
                                      StageObserver* observer) noexcept {
  SegmentationReport report;
  const auto done = [observer](Stage stage) noexcept {
    if (observer != nullptr) observer->stage_done(stage);
  };

  // Coarse: heights above the ground of the ring-based elevation map.
  elevation_map_.segment(image, planes_);
  done(Stage::kElevationMap);

  // Finer: steps between adjacent points too steep for ground.
  if (config_.last_stage >= Stage::kAdjacentPoints) adjacent_points_.refine(image, planes_);
  done(Stage::kAdjacentPoints);

  // Fine: what is not certain yet is labelled together, by the cheapest cut of the range image.
  report.last_stage = config_.last_stage;
  if (config_.last_stage >= Stage::kMinCut && has_expired(budget)) {
    report.last_stage = Stage::kAdjacentPoints;
  }
  if (report.last_stage >= Stage::kMinCut) {
    seeds_.select(planes_);
    region_.evaluate(image, planes_, seeds_.seeds());
    done(Stage::kSeeds);
    report.cut = cut(image, budget);
    done(Stage::kMinCut);
    if (report.cut.discarded) report.last_stage = Stage::kAdjacentPoints;
  }

  return_labels_.assign(image, planes_);
  done(Stage::kLabels);

  report.count(return_labels_.labels());
  return report;
}

CutReport Segmenter::cut(const RangeImage& image, const CutBudget& budget) noexcept {
  const GridProblem problem{shape_, seeds_.seeds(), region_.cost_ground(), region_.cost_obstacle(),
                            image.ground_range_m()};
  return min_cut_.solve(problem, BoundaryTerm(config_.boundary, negative_exp_, image), budget,
                        planes_.label);
}

}  // namespace terracut::pipeline
