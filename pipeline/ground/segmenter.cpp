// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/segmenter.hpp"

#include <memory>

namespace terracut::ground {

Segmenter::Segmenter(const SegmenterConfig& config, const mount::RingProfile& profile,
                     frame::ImageShape shape, std::size_t return_capacity,
                     memory::FixedMemory& memory)
    : last_stage_(config.last_stage),
      below_m_(config.ghost_limit_m()),
      planes_(shape, memory),
      coarse_(config, profile, shape, memory),
      fine_(config, profile, shape, memory),
      return_labels_(config.returns, config.elevation_map.obstacle_height_m, return_capacity,
                     memory) {
  if (config.gives_heights) return_heights_.emplace(return_capacity, memory);
  if (config.road.enabled) road_surface_.emplace(config.road, shape, memory);
}

stage::SegmentationReport Segmenter::segment(const frame::RangeImage& image,
                                             const min_cut::CutBudget& budget,
                                             stage::StageObserver* observer) noexcept {
  stage::resumed(observer);
  const frame::PointPlanes points = image.points();
  const auto stride = static_cast<std::uint32_t>(image.shape().stride());
  coarse_.begin();
  fine_.begin();
  for (const frame::OverflowReturn& extra : image.overflow()) {
    coarse_.take_extra(static_cast<int>(extra.cell % stride), extra.point.z_m,
                       extra.point.ground_range_m);
  }
  coarse_.take_to(coarse_.grid().sectors(), points, observer);
  coarse_.label_circle(points, planes_, observer);

  stage::SegmentationReport report;
  report.last_stage = last_stage_;
  if (last_stage_ >= stage::Stage::kMinCut) {
    const bool is_late = budget.expired != nullptr && budget.expired(budget.context);
    if (!is_late) fine_.label_circle(points, planes_, budget, observer);
    report.cut = fine_.take_report();
    if (is_late || report.cut.discarded) report.last_stage = stage::Stage::kAdjacentPoints;
  }
  return_labels_.assign(image, planes_);
  if (return_heights_) {
    return_heights_->assign(image, planes_,
                            [this](int column, float z_m, float ground_range_m) noexcept {
                              return coarse_.height_of(column, z_m, ground_range_m);
                            });
  }
  if (road_surface_) road_surface_->mark(image, planes_, return_labels_.mutable_labels());
  stage::done(stage::Stage::kLabels, observer);

  report.count(return_labels_.labels());
  report.below = stage::count_below(planes_.height_m, below_m_);
  return report;
}

MethodMaker maker_of(const SegmenterConfig& config) {
  return [config](FramesToCome frames, memory::FixedMemory& memory) {
    return std::make_unique<Segmenter>(config, frames.profile, frames.shape, frames.return_capacity,
                                       memory);
  };
}

}  // namespace terracut::ground
