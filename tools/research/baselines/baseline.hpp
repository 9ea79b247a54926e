// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "firmware_io/frame/range_image.hpp"
#include "pipeline/ground/frame_method.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/stage/return_labels.hpp"
#include "pipeline/stage/segmentation_report.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::baselines {

/// A method that ours is compared with. It works on whole frames only and keeps nothing from one
/// frame to the next.
class Baseline : public ground::FrameMethod {
 public:
  /// Ignores the budget. Reports the stage of our method that this method resembles most as the
  /// last one.
  [[nodiscard]] stage::SegmentationReport segment(
      const frame::RangeImage& image, const min_cut::CutBudget& /*budget*/ = {},
      stage::StageObserver* observer = nullptr) noexcept override {
    if (observer != nullptr) observer->resumed();
    label_cells(image, observer);
    return_labels_.assign(image, planes_);
    if (observer != nullptr) observer->stage_done(stage::Stage::kLabels);
    stage::SegmentationReport report;
    report.last_stage = last_stage_;
    report.count(return_labels_.labels());
    return report;
  }

  [[nodiscard]] std::span<const frame::Label> labels() const noexcept override {
    return return_labels_.labels();
  }
  [[nodiscard]] const stage::CellPlanes& planes() const noexcept override { return planes_; }

 protected:
  /// `last_stage` is the stage of our method that this method resembles most. `obstacle_height_m`
  /// applies to a cell's second returns.
  Baseline(stage::Stage last_stage, float obstacle_height_m, frame::ImageShape shape,
           std::size_t return_capacity, memory::FixedMemory& memory)
      : planes_(shape, memory),
        last_stage_(last_stage),
        return_labels_({}, obstacle_height_m, return_capacity, memory) {}

  /// Fills `height_m` and `label` of planes_, and reports the stages before kLabels.
  virtual void label_cells(const frame::RangeImage& image,
                           stage::StageObserver* observer) noexcept TERRACUT_NONBLOCKING = 0;

  stage::CellPlanes planes_;

 private:
  stage::Stage last_stage_;
  stage::ReturnLabels return_labels_;
};

}  // namespace terracut::baselines
