// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/fine_stages.hpp"

#include <algorithm>
#include <utility>

#include "pipeline/random_field/boundary_term.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::ground {
namespace {

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
                       frame::ImageShape shape, memory::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      seeds_(config.seeds, config.adjacent_points.row_step_deg, profile, shape, memory),
      region_(config.region),
      open_(shape, kOpenCells, memory),
      min_cut_(shape, config.min_cut, memory) {}

void FineStages::begin() noexcept {
  seeded_columns_ = cut_columns_ = 0;
  spent_ops_ = 0;
  report_ = {};
  open_.begin(0);
}

void FineStages::label_circle(const frame::PointPlanes& points, stage::CellPlanes& planes,
                              const min_cut::CutBudget& budget,
                              stage::StageObserver* observer) noexcept {
  cut_columns_ = shape_.columns;
  if (!has_cut()) return;
  select_to(shape_.columns, points, planes);
  stage::done(stage::Stage::kSeeds, observer);
  cut({0, shape_.columns}, points, planes, budget);
  stage::done(stage::Stage::kMinCut, observer);
}

void FineStages::begin_next_turn() noexcept {
  seeded_columns_ -= shape_.columns;
  cut_columns_ -= shape_.columns;
  spent_ops_ = 0;
}

void FineStages::label_to(int coarse_columns, const frame::PointPlanes& points,
                          stage::CellPlanes& planes, const min_cut::CutBudget& budget,
                          stage::StageObserver* observer) noexcept {
  if (!has_cut()) {
    cut_columns_ = coarse_columns;
    return;
  }
  // Seeds depend on coarse labels around them, which a cut replaces.
  const int seeded = coarse_columns - seeds_.reach();
  select_to(seeded, points, planes);
  stage::done(stage::Stage::kSeeds, observer);
  cut_to(seeded - seeds_.reach(), points, planes, budget);
  stage::done(stage::Stage::kMinCut, observer);
}

void FineStages::label_until(int column, const frame::PointPlanes& points,
                             stage::CellPlanes& planes, const min_cut::CutBudget& budget,
                             stage::StageObserver* observer) noexcept {
  if (has_cut()) {
    select_to(column, points, planes);
    stage::done(stage::Stage::kSeeds, observer);
    cut_to(column, points, planes, budget);
    cut_released(open_.release_all(seeds_.mutable_seeds()), points, planes, budget);
    stage::done(stage::Stage::kMinCut, observer);
  }
  cut_columns_ = std::max(cut_columns_, column);
}

min_cut::CutReport FineStages::take_report() noexcept {
  // Each cut says whether it was discarded; together they were if no cell is from a cut.
  report_.discarded =
      report_.unknown > 0 && report_.unknown == report_.coarse_by_cap + report_.coarse_by_budget;
  return std::exchange(report_, {});
}

void FineStages::select_to(int end, const frame::PointPlanes& points,
                           const stage::CellPlanes& planes) noexcept {
  while (seeded_columns_ < end) {
    const int first = seeded_columns_ < 0 ? seeded_columns_ + shape_.columns : seeded_columns_;
    const int count = std::min(end - seeded_columns_, shape_.columns - first);
    seeds_.select(planes, {first, first + count});
    seeded_columns_ += count;
  }
  region_.look_at(points, planes, seeds_.seeds());
}

void FineStages::cut_to(int end, const frame::PointPlanes& points, stage::CellPlanes& planes,
                        const min_cut::CutBudget& budget) noexcept {
  while (cut_columns_ < end) {
    // Steps end at the same columns of every turn.
    const int of_turn = cut_columns_ < 0 ? cut_columns_ + shape_.columns : cut_columns_;
    const int step = std::min({kColumnsAtOnce - of_turn % kColumnsAtOnce, shape_.columns - of_turn,
                               open_.most_at_once()});
    if (cut_columns_ + step > end) return;
    if (!open_.has_room(step)) {
      cut_released(open_.release_all(seeds_.mutable_seeds()), points, planes, budget);
    }
    const auto released = open_.take(step, seeds_.mutable_seeds());
    cut_columns_ += step;
    cut_released(released, points, planes, budget);
  }
}

void FineStages::cut_released(const min_cut::OpenComponents::Released& released,
                              const frame::PointPlanes& points, stage::CellPlanes& planes,
                              const min_cut::CutBudget& budget) noexcept {
  if (released.cells == 0) return;
  // What would join an open component waits: it is cut later, against the labels found now.
  if (released.cells_open > 0) {
    change_next_column(min_cut::Seed::kUnknown, min_cut::Seed::kWaiting);
  }
  cut(released.window, points, planes, budget);
  if (released.cells_open > 0) {
    change_next_column(min_cut::Seed::kWaiting, min_cut::Seed::kUnknown);
    report_.cut_open += released.cells_open;
  }
}

void FineStages::change_next_column(min_cut::Seed from, min_cut::Seed to) noexcept {
  const int column =
      cut_columns_ < 0 ? cut_columns_ + shape_.columns : cut_columns_ % shape_.columns;
  for (int row = 0; row < shape_.rows; ++row) {
    min_cut::Seed& seed = seeds_.mutable_seeds()[shape_.cell(row, column)];
    if (seed == from) seed = to;
  }
}

void FineStages::cut(min_cut::ColumnWindow window, const frame::PointPlanes& points,
                     stage::CellPlanes& planes, const min_cut::CutBudget& budget) noexcept {
  const min_cut::GridProblem problem{
      shape_, window, seeds_.mutable_seeds(), {points.ground_range_m, shape_.cells()}};
  const random_field::BoundaryTerm boundary(config_.boundary, negative_exp_, points);
  min_cut::CutBudget left = budget;
  left.ops -= spent_ops_;
  const min_cut::CutReport cut = solve(min_cut_, problem, region_, boundary, left, planes.label);
  spent_ops_ += cut.operations();
  report_ += cut;
}

}  // namespace terracut::ground
