// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/points/labelled_point.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::points {

/// Finds what is wanted in a labelled turn that has left the threads with a deadline: puts its
/// points back into an image, by their rows and azimuths, and looks there (scene::SceneFinder).
/// Points may be deskewed. How far the sensor sees needs them in the cells in which they were
/// measured: SightOfPoints.
///
/// Takes its memory in the constructor; allocates nothing later. One thread at a time.
class SceneOfPoints {
 public:
  /// `profile` must have shape.rows rings; a turn has at most `most_points` points, further ones
  /// are not looked at. `wanted.sight` makes no difference.
  SceneOfPoints(scene::Wanted wanted, const mount::RingProfile& profile, frame::ImageShape shape,
                std::size_t most_points);

  /// Looks at a turn. `heights_m` has the height of each point above the ground.
  void find(std::span<const LabelledPoint> points, std::span<const float> heights_m) noexcept;

  /// Returns what was found; the index of a return is that of its point.
  [[nodiscard]] const scene::SceneFinder& found() const noexcept { return scene_; }

 private:
  void place(std::span<const LabelledPoint> points) noexcept;

  memory::FixedMemory memory_;
  std::size_t most_points_;
  frame::RangeImage image_;
  scene::SceneFinder scene_;
  std::vector<frame::Label> labels_;
};

}  // namespace terracut::points
