// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/fine_stages.hpp"

#include "pipeline/random_field/boundary_term.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::ground {
namespace {

bool has_expired(const min_cut::CutBudget& budget) noexcept {
  return budget.expired != nullptr && budget.expired(budget.context);
}

/// The edge weights, most of the cut's work, are compiled into this function.
TERRACUT_VECTOR_CLONES_OF_INLINED min_cut::CutReport solve(
    min_cut::GridCut& cut, const min_cut::GridProblem& problem,
    const random_field::RegionTerm& region, const random_field::BoundaryTerm& boundary,
    const min_cut::CutBudget& budget,
    std::span<frame::Label> labels) noexcept TERRACUT_NONBLOCKING {
  return cut.solve(problem, region, boundary, budget, labels);
}

}  // namespace

FineStages::FineStages(const SegmenterConfig& config, const mount::RingProfile& profile,
                       frame::ImageShape shape, std::size_t return_capacity,
                       memory::FixedMemory& memory, frame::FramePoints* made)
    : config_(config),
      shape_(shape),
      seeds_(config.seeds, config.adjacent_points.row_step_deg, profile, shape, memory),
      region_(config.region),
      made_(made),
      near_unknown_(shape, memory),
      min_cut_(shape, config.min_cut, memory),
      return_labels_(config.returns, config.elevation_map.obstacle_height_m, return_capacity,
                     memory) {
  if (!config.road.enabled) return;
  road_surface_.emplace(config.road, shape, memory);
  if (made != nullptr) road_points_.emplace(shape, return_capacity, memory);
}

frame::PointPlanes FineStages::points_of(const frame::FrameReturns& frame, bool has_cut) noexcept {
  if (made_ == nullptr) return frame.image()->points();
  const frame::MeasuredReturns& returns = *frame.measured();
  if (made_->has_all_of(returns)) return made_->planes();
  const bool needs_all = has_cut && config_.region.rule == random_field::RegionRule::kHistogram;
  if (has_cut) near_unknown_.find(seeds_.seeds());
  made_->make_where(returns, [&](int row, frame::ColumnRange columns) noexcept {
    return needs_all || (has_cut && near_unknown_.is_near(row, columns)) ||
           returns.has_shared(row, columns);
  });
  return made_->planes();
}

const frame::RangeImage& FineStages::image_of(const frame::FrameReturns& frame) noexcept {
  if (!road_points_) return *frame.image();
  road_points_->fill(*frame.measured(), made_->reader());
  return *road_points_;
}

void FineStages::take_near_ground(const frame::FrameReturns& frame, const stage::CellPlanes& planes,
                                  NearGround& ground) noexcept {
  if (made_ == nullptr) return ground::take_near_ground(*frame.image(), ground);
  made_->make_where(*frame.measured(), [this](int, frame::ColumnRange columns) noexcept {
    return has_near_ground_columns(columns, shape_);
  });
  ground::take_near_ground(made_->planes(), planes.height_m, shape_, ground);
}

stage::SegmentationReport FineStages::refine(const frame::FrameReturns& frame,
                                             stage::CellPlanes& planes,
                                             const min_cut::CutBudget& budget,
                                             stage::StageObserver* observer) noexcept {
  stage::SegmentationReport report;
  const auto done = [observer](stage::Stage stage) noexcept {
    if (observer != nullptr) observer->stage_done(stage);
  };
  if (observer != nullptr) observer->resumed();

  // The cut labels all cells that are still uncertain together.
  report.last_stage = config_.last_stage;
  if (config_.last_stage >= stage::Stage::kMinCut && has_expired(budget)) {
    report.last_stage = stage::Stage::kAdjacentPoints;
  }
  frame::PointPlanes points{};
  if (report.last_stage >= stage::Stage::kMinCut) {
    seeds_.select(planes);
    points = points_of(frame, true);
    region_.look_at(points, planes, seeds_.seeds());
    done(stage::Stage::kSeeds);
    report.cut = cut(points, planes, budget);
    done(stage::Stage::kMinCut);
    if (report.cut.discarded) report.last_stage = stage::Stage::kAdjacentPoints;
  } else {
    points = points_of(frame, false);
  }

  if (made_ != nullptr) {
    return_labels_.assign(*frame.measured(), points, made_->reader(), planes);
  } else {
    return_labels_.assign(*frame.image(), planes);
  }
  if (road_surface_) road_surface_->mark(image_of(frame), planes, return_labels_.mutable_labels());
  done(stage::Stage::kLabels);

  report.count(return_labels_.labels());
  report.below = stage::count_below(planes.height_m, -2 * config_.elevation_map.obstacle_height_m);
  return report;
}

min_cut::CutReport FineStages::cut(const frame::PointPlanes& points, stage::CellPlanes& planes,
                                   const min_cut::CutBudget& budget) noexcept {
  const min_cut::GridProblem problem{
      shape_, seeds_.mutable_seeds(), {points.ground_range_m, shape_.cells()}};
  const random_field::BoundaryTerm boundary(config_.boundary, negative_exp_, points);
  return solve(min_cut_, problem, region_, boundary, budget, planes.label);
}

}  // namespace terracut::ground
