// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

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

/// The coarse-to-fine method: a range image goes in, a label for every return comes out.
///
/// Memory is taken in the constructor and never again; segment() does not allocate, lock, throw or
/// look at a clock, and the same image gives the same labels on every machine (unless a budget with
/// a clock cuts the min-cut short). One thread at a time.
class Segmenter {
 public:
  /// `profile` must have shape.rows rings. `return_capacity`: of the images to come.
  Segmenter(const SegmenterConfig& config, const calib::RingProfile& profile, ImageShape shape,
            std::size_t return_capacity, rt::FixedMemory& memory);

  /// Labels one turn; `image` has the shape given at construction. The result of the turn before is
  /// overwritten. Where `budget` has expired before the random field, or too soon in its cut,
  /// labels stay those of the stages before. Real-time safe if the observer is.
  [[nodiscard]] SegmentationReport segment(const RangeImage& image, const CutBudget& budget = {},
                                           StageObserver* observer = nullptr) noexcept
      TERRACUT_NONBLOCKING;

  /// One label a return, in order of arrival (RangeImage::return_index()).
  [[nodiscard]] std::span<const Label> labels() const noexcept { return return_labels_.labels(); }
  /// The same by cell, with the heights they were judged by; for pictures and measurements.
  [[nodiscard]] const CellPlanes& planes() const noexcept { return planes_; }

 private:
  [[nodiscard]] CutReport cut(const RangeImage& image, const CutBudget& budget) noexcept;

  SegmenterConfig config_;
  ImageShape shape_;
  NegativeExp negative_exp_;
  CellPlanes planes_;
  RingElevationMap elevation_map_;
  AdjacentPoints adjacent_points_;
  ConfidenceSeeds seeds_;
  RegionTerm region_;
  GridCut min_cut_;
  ReturnLabels return_labels_;
};

}  // namespace terracut::pipeline
