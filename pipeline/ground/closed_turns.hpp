// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "firmware_io/frame/point_image.hpp"
#include "pipeline/ground/frame_method.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "pipeline/ground/turn_method.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ground {

/// Labels each turn by itself, when it is whole, by a method on images of points: a method that
/// ours is compared with, or ours with the road surface, which needs the whole image.
///
/// All memory is taken in the constructor. One thread; real-time safe if the method and the
/// observer are.
class ClosedTurns final : public TurnMethod {
 public:
  /// `turns.reader` is used here; `method` gets the other arguments.
  ClosedTurns(const MethodMaker& method, FramesToCome turns, memory::FixedMemory& memory)
      : image_(turns.shape, turns.return_capacity, std::move(turns.reader), memory),
        method_(method({.profile = turns.profile,
                        .shape = turns.shape,
                        .return_capacity = turns.return_capacity},
                       memory)) {}

  void advance(const frame::MeasuredReturns& /*turn*/, int /*complete_columns*/,
               const min_cut::CutBudget& /*budget*/,
               stage::StageObserver* /*observer*/) noexcept TERRACUT_NONBLOCKING override {}
  void end_turn(const frame::MeasuredReturns& turn, const min_cut::CutBudget& budget,
                stage::StageObserver* observer) noexcept TERRACUT_NONBLOCKING override {
    const frame::RangeImage& image = image_.make(turn);
    report_ = method_->segment(image, budget, observer);
    if (near_ground_ != nullptr) take_near_ground(image, *near_ground_);
    labelled_ = &turn;
  }
  void close(const min_cut::CutBudget& /*budget*/,
             stage::StageObserver* /*observer*/) noexcept TERRACUT_NONBLOCKING override {}

  [[nodiscard]] const frame::MeasuredReturns* labelled() const noexcept
      TERRACUT_NONBLOCKING override {
    return labelled_;
  }
  void release() noexcept TERRACUT_NONBLOCKING override { labelled_ = nullptr; }
  [[nodiscard]] const frame::MeasuredReturns* at_work() const noexcept
      TERRACUT_NONBLOCKING override {
    return labelled_;
  }
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept
      TERRACUT_NONBLOCKING override {
    return method_->labels();
  }
  [[nodiscard]] std::span<const float> heights_m() const noexcept TERRACUT_NONBLOCKING override {
    return method_->heights_m();
  }
  [[nodiscard]] const stage::SegmentationReport& report() const noexcept
      TERRACUT_NONBLOCKING override {
    return report_;
  }
  void watch_near_ground(NearGround* ground) noexcept TERRACUT_NONBLOCKING override {
    near_ground_ = ground;
  }

 private:
  frame::PointImage image_;
  std::unique_ptr<FrameMethod> method_;  // never null
  const frame::MeasuredReturns* labelled_ = nullptr;
  NearGround* near_ground_ = nullptr;
  stage::SegmentationReport report_;
};

/// Returns a function that makes a method which labels each turn by itself.
[[nodiscard]] inline TurnMethodMaker closed_turns_of(MethodMaker method) {
  return [method = std::move(method)](FramesToCome turns, memory::FixedMemory& memory) {
    return std::make_unique<ClosedTurns>(method, std::move(turns), memory);
  };
}

}  // namespace terracut::ground
