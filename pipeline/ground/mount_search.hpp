// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>

#include "calib/mount/mount_finder.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/ground/near_ground.hpp"

namespace terracut::ground {

/// Finds the mount from the near ground of the first frames of a run. Start-up: allocates.
class MountSearch {
 public:
  /// Of a sensor whose mount is mount::kAtTheSensor.
  void add_frame(const frame::RangeImage& image) {
    take_near_ground(image, *ground_);
    finder_.add_frame(ground_->in_use());
  }
  [[nodiscard]] bool has_enough_frames() const noexcept {
    return finder_.frames_looked_at() >= mount::kFramesToFind;
  }
  /// MountFinder::certain()
  [[nodiscard]] Expected<mount::FoundMount> found() const { return finder_.certain(); }
  [[nodiscard]] const mount::MountFinder& finder() const noexcept { return finder_; }

 private:
  std::unique_ptr<NearGround> ground_ = std::make_unique<NearGround>();
  mount::MountFinder finder_;
};

}  // namespace terracut::ground
