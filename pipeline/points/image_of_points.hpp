// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/points/frame_timing.hpp"
#include "pipeline/points/labelled_point.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::points {

/// Finds the azimuths of points as frame::find_azimuths() does. `azimuths_rad` has one element per
/// point.
void find_azimuths(std::span<const LabelledPoint> points, std::span<float> azimuths_rad) noexcept;

/// Puts the points of a turn back into an image, by their rows and azimuths. The index of a return
/// is that of its point. `image` must have room for all points.
void place_by_azimuth(std::span<const LabelledPoint> points, frame::RangeImage& image) noexcept;

/// Puts the points of a turn back where they were measured: into the cells of their beams, which
/// their times tell, and, if the turn was deskewed, without the motion that was removed. Points
/// without times are placed by their azimuths.
///
/// Takes its memory in the constructor; allocates nothing later. One thread at a time.
class MeasuredImage {
 public:
  /// A turn has at most `most_points` points. `beam_turns` is that of the decoder, or empty.
  MeasuredImage(frame::ImageShape shape, std::size_t most_points, std::span<const float> beam_turns,
                memory::FixedMemory& memory);

  /// Returns the image of a turn, of which `info` tells, valid until the next call.
  const frame::RangeImage& make(const frame::FrameInfo& info,
                                std::span<const LabelledPoint> points) noexcept;

 private:
  frame::RangeImage image_;
  std::vector<float> beam_turns_;
  std::vector<RowTimes> row_times_;  // of the turn
};

}  // namespace terracut::points
