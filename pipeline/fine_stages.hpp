// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <span>

#include "calib/ring_profile.hpp"
#include "pipeline/cell_planes.hpp"
#include "pipeline/label.hpp"
#include "pipeline/profile.hpp"
#include "pipeline/range_image.hpp"
#include "pipeline/segmentation_report.hpp"
#include "pipeline/stage.hpp"
#include "rt/fixed_memory.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::pipeline {

/// The fine stage of the method, the random field and its cut, and what makes labels of returns of
/// it. Begins where CoarseStages ends, on the same thread or another one.
///
/// Memory is taken in the constructor. One thread at a time; real-time safe if the observer is.
class FineStages {
 public:
  /// `profile` must have shape.rows rings. `return_capacity`: of the images to come.
  FineStages(const SegmenterConfig& config, const calib::RingProfile& profile, ImageShape shape,
             std::size_t return_capacity, rt::FixedMemory& memory);

  /// Labels the returns of a turn. `planes`: what CoarseStages::finish() made of it; labels in them
  /// become final. Where `budget` has expired before the random field, or too soon in its cut,
  /// labels stay as they were.
  [[nodiscard]] SegmentationReport refine(
      const RangeImage& image, CellPlanes& planes, const CutBudget& budget = {},
      StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;

  /// As Segmenter::labels().
  [[nodiscard]] std::span<const Label> labels() const noexcept { return return_labels_.labels(); }

 private:
  [[nodiscard]] CutReport cut(const RangeImage& image, CellPlanes& planes,
                              const CutBudget& budget) noexcept;

  SegmenterConfig config_;
  ImageShape shape_;
  NegativeExp negative_exp_;
  ConfidenceSeeds seeds_;
  RegionTerm region_;
  GridCut min_cut_;
  ReturnLabels return_labels_;
  std::optional<RoadSurface> road_surface_;  // where it is asked for
};

}  // namespace terracut::pipeline
