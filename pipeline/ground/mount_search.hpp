// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>

#include "calib/mount/mount_finder.hpp"
#include "calib/mount/turned_mount.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/ground/near_ground.hpp"

namespace terracut::ground {

/// Finds the mount from the near ground in a run's first frames. Tries an upright sensor first; if
/// the result is uncertain, a tilted or inverted one; and last an upright one with ground up to 30
/// m away. Start-up only: allocates.
class MountSearch {
 public:
  /// Adds a frame that was decoded with the mount mount::kAtTheSensor.
  void add_frame(const frame::RangeImage& image) {
    take_near_ground(image, *ground_);
    Expected<mount::MountEstimate> standing = mount::estimate_mount(ground_->in_use());
    const auto any_way_up = standing ? standing : turned_mount(image);
    if (!any_way_up) standing.error().message += "; " + any_way_up.error().message;
    standing_.add_estimate(standing);
    any_way_up_.add_estimate(any_way_up);
    take_near_ground(image, *ground_, static_cast<float>(mount::kFarStrip.farthest_m));
    by_far_ground_.add_estimate(mount::estimate_mount(ground_->in_use(), mount::kFarStrip));
  }
  [[nodiscard]] bool has_enough_frames() const noexcept {
    return standing_.frames_looked_at() >= mount::kFramesToFind;
  }
  /// Returns the mount found, or the errors of MountFinder::certain().
  [[nodiscard]] Expected<mount::FoundMount> found() const { return finder().certain(); }
  [[nodiscard]] const mount::MountFinder& finder() const {
    if (standing_.certain()) return standing_;
    if (any_way_up_.certain()) return any_way_up_;
    return by_far_ground_.certain() ? by_far_ground_ : standing_;
  }

 private:
  [[nodiscard]] Expected<mount::MountEstimate> turned_mount(const frame::RangeImage& image) const {
    const auto around = std::make_unique<NearGround>();
    take_around(image, *around);
    return mount::estimate_turned_mount(ground_->in_use(), around->in_use());
  }

  std::unique_ptr<NearGround> ground_ = std::make_unique<NearGround>();
  mount::MountFinder standing_, any_way_up_, by_far_ground_;
};

}  // namespace terracut::ground
