// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <span>

#include "pipeline/ground/coarse_stages.hpp"
#include "pipeline/ground/fine_stages.hpp"
#include "pipeline/ground/frame_method.hpp"
#include "pipeline/stage/return_heights.hpp"

namespace terracut::ground {

/// The coarse-to-fine method on range images, each by itself: labels every return. (On a stream of
/// turns: StreamSegmenter.)
///
/// All memory is taken in the constructor; no other function allocates, locks, throws or looks at a
/// clock. The same image gives the same labels on every machine (unless a budget with a clock cuts
/// the min-cut short). One thread at a time.
class Segmenter final : public FrameMethod {
 public:
  /// `profile` must have shape.rows rings. `return_capacity` is the most returns of an image.
  Segmenter(const SegmenterConfig& config, const mount::RingProfile& profile,
            frame::ImageShape shape, std::size_t return_capacity, memory::FixedMemory& memory);

  /// Labels one image, of the shape given at construction. Overwrites the last image's result. If
  /// `budget` expires before the random field, or early in the cut, the labels of the coarse stages
  /// stay. Real-time safe if the observer is.
  [[nodiscard]] stage::SegmentationReport segment(
      const frame::RangeImage& image, const min_cut::CutBudget& budget = {},
      stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING override;

  /// Returns one label per return, in order of arrival (RangeImage::return_index()). kGround is all
  /// ground; with road.enabled, kGround is road and kOtherGround is all other ground.
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept override {
    return return_labels_.labels();
  }
  [[nodiscard]] bool gives_heights() const noexcept override { return return_heights_.has_value(); }
  [[nodiscard]] std::span<const float> heights_m() const noexcept override {
    return return_heights_ ? return_heights_->heights_m() : std::span<const float>();
  }
  /// Returns for each cell its label and the height that led to the label; for pictures and
  /// measurements.
  [[nodiscard]] const stage::CellPlanes& planes() const noexcept override { return planes_; }

 private:
  stage::Stage last_stage_;
  float below_m_;
  stage::CellPlanes planes_;
  CoarseStages coarse_;
  FineStages fine_;
  stage::ReturnLabels return_labels_;
  std::optional<stage::ReturnHeights> return_heights_;  // empty unless asked for
  std::optional<road::RoadSurface> road_surface_;       // empty unless enabled
};

/// Returns a function that makes Segmenters.
[[nodiscard]] MethodMaker maker_of(const SegmenterConfig& config);

}  // namespace terracut::ground
