// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/points/image_of_points.hpp"
#include "pipeline/points/labelled_point.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::points {

/// Finds what is wanted in a labelled turn that has left the threads with a deadline: puts its
/// points back into images and looks there (scene::SceneFinder). Objects are found where points
/// lie, by their azimuths; the free way and the view where they were measured (MeasuredImage), so
/// that no beam looks lost because the vehicle moves.
///
/// Takes its memory in the constructor; allocates nothing later. One thread at a time.
class SceneOfPoints {
 public:
  /// `profile` must have shape.rows rings; a turn has at most `most_points` points, further ones
  /// are not looked at. `beam_turns` is that of the decoder; empty: points have no times.
  SceneOfPoints(scene::Wanted wanted, const mount::RingProfile& profile, frame::ImageShape shape,
                std::size_t most_points, std::span<const float> beam_turns);

  /// Looks at a turn, of which `info` tells. `heights_m` has the height of each point above the
  /// ground. For the view, turns follow each other; one that is not whole
  /// (visibility::SightWatch::is_whole()) is counted as left out.
  void find(const frame::FrameInfo& info, std::span<const LabelledPoint> points,
            std::span<const float> heights_m) noexcept;

  /// Returns what was found; the index of a return is that of its point.
  [[nodiscard]] const scene::SceneFinder& found() const noexcept { return scene_; }

 private:
  memory::FixedMemory memory_;
  std::size_t most_points_;
  std::optional<frame::RangeImage> image_;    ///< Exists if objects are wanted.
  std::optional<MeasuredImage> as_measured_;  ///< Exists if the free way or the view is wanted.
  scene::SceneFinder scene_;
  std::vector<frame::Label> labels_;
};

}  // namespace terracut::points
