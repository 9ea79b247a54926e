// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/label.hpp"
#include "pipeline/points/image_of_points.hpp"
#include "pipeline/points/labelled_point.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::points {

/// Watches how far the sensor sees in labelled turns that have left the threads with a deadline:
/// puts each point back to where its beam measured it (MeasuredImage) and looks there
/// (visibility::SightWatch). Points may be deskewed: they come back into their beams' cells, so
/// that no beam looks lost because the vehicle moves.
///
/// Takes its memory in the constructor; allocates nothing later. One thread at a time.
class SightOfPoints {
 public:
  /// `profile` must have shape.rows rings; a turn has at most `most_points` points, further ones
  /// are not looked at. `beam_turns` is that of the decoder (decode::Decoder::beam_turns()).
  SightOfPoints(const mount::RingProfile& profile, frame::ImageShape shape, std::size_t most_points,
                std::span<const float> beam_turns);

  /// Looks at the next turn. `heights_m` has the height of each point above the ground, `info` is
  /// the frame's. A turn that is not whole (visibility::SightWatch::is_whole()) is counted as left
  /// out.
  void look(std::span<const LabelledPoint> points, std::span<const float> heights_m,
            const frame::FrameInfo& info) noexcept;

  /// Returns what is known since the last turn.
  [[nodiscard]] visibility::SightFigures figures() const noexcept { return scene_.sight(); }

 private:
  memory::FixedMemory memory_;
  std::size_t most_points_;
  MeasuredImage image_;
  scene::SceneFinder scene_;
  std::vector<frame::Label> labels_;
};

}  // namespace terracut::points
