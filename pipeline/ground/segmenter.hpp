// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "pipeline/ground/coarse_stages.hpp"
#include "pipeline/ground/fine_stages.hpp"
#include "pipeline/ground/frame_method.hpp"

namespace terracut::ground {

/// The coarse-to-fine method: labels every return of a frame.
///
/// All memory is taken in the constructor; no other function allocates, locks, throws or looks at a
/// clock. The same frame gives the same labels on every machine (unless a budget with a clock cuts
/// the min-cut short). One thread at a time; two threads use CoarseStages and FineStages instead.
class Segmenter final : public FrameMethod {
 public:
  /// `profile` must have shape.rows rings. `return_capacity` is the most returns of a frame. If
  /// frames are decoded, `reader` is the sensor's tile reader; null for clouds.
  Segmenter(const SegmenterConfig& config, const mount::RingProfile& profile,
            frame::ImageShape shape, std::size_t return_capacity, memory::FixedMemory& memory,
            std::unique_ptr<frame::TileReader> reader = nullptr)
      : planes_(shape, memory),
        made_(reader == nullptr
                  ? nullptr
                  : std::make_unique<frame::FramePoints>(shape, std::move(reader), memory)),
        coarse_(config, profile, shape, memory, made_.get()),
        fine_(config, profile, shape, return_capacity, memory, made_.get()) {}

  /// Does part of the work on a frame while it is still arriving (CoarseStages::advance()). The
  /// labels are the same without it. Overwrites planes(), but not labels().
  void advance(const frame::FrameReturns& frame, int complete_columns,
               stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING override {
    coarse_.advance(frame, complete_columns, planes_, observer);
  }

  /// Labels one frame, which has the shape given at construction. Overwrites the last frame's
  /// result. `budget`: see FineStages::refine(). Real-time safe if the observer is.
  [[nodiscard]] stage::SegmentationReport segment(
      const frame::FrameReturns& frame, const min_cut::CutBudget& budget = {},
      stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING override {
    coarse_.finish(frame, planes_, observer);
    return fine_.refine(frame, planes_, budget, observer);
  }

  /// Fills `ground` with near ground from the frame labelled last.
  void take_near_ground(const frame::FrameReturns& frame,
                        NearGround& ground) noexcept TERRACUT_NONBLOCKING override {
    fine_.take_near_ground(frame, planes_, ground);
  }

  /// Returns one label per return, in order of arrival (RangeImage::return_index()). kGround is all
  /// ground; with road.enabled, kGround is road and kOtherGround is all other ground.
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept override {
    return fine_.labels();
  }
  /// Returns for each cell its label and the height that led to the label; for pictures and
  /// measurements.
  [[nodiscard]] const stage::CellPlanes& planes() const noexcept override { return planes_; }

 private:
  stage::CellPlanes planes_;
  std::unique_ptr<frame::FramePoints> made_;  // set if frames are decoded
  CoarseStages coarse_;
  FineStages fine_;
};

/// Returns a function that makes Segmenters.
[[nodiscard]] inline MethodMaker maker_of(const SegmenterConfig& config) {
  return [config](FramesToCome frames, memory::FixedMemory& memory) {
    return std::make_unique<Segmenter>(config, frames.profile, frames.shape, frames.return_capacity,
                                       memory, std::move(frames.reader));
  };
}

}  // namespace terracut::ground
