// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/objects/image_objects.hpp"
#include "pipeline/points/labelled_point.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::points {

/// Finds the objects in a labelled turn that has left the threads with a deadline: puts its points
/// back into an image, by their rows and azimuths, and looks there (objects::ImageObjects). Points
/// may be deskewed.
///
/// Takes its memory in the constructor; allocates nothing later. One thread at a time.
class ObjectsOfPoints {
 public:
  /// `profile` must have shape.rows rings; a turn has at most `most_points` points, further ones
  /// belong to no object.
  ObjectsOfPoints(const mount::RingProfile& profile, frame::ImageShape shape,
                  std::size_t most_points);

  /// Finds the objects of a turn. `heights_m` has the height of each point above the ground.
  void find(std::span<const LabelledPoint> points, std::span<const float> heights_m) noexcept;

  /// Returns the objects; object i has the number i + 1.
  [[nodiscard]] std::span<const objects::Object> objects() const noexcept {
    return objects_.objects();
  }
  /// Returns both, by return index, which is the index of the point.
  [[nodiscard]] const objects::ImageObjects& found() const noexcept { return objects_; }
  /// Returns the number of each point's object; 0: none.
  [[nodiscard]] std::span<const std::uint16_t> object_of_point() const noexcept {
    return objects_.object_of_return();  // the number of a return is that of its point
  }

 private:
  void place(std::span<const LabelledPoint> points) noexcept;

  memory::FixedMemory memory_;
  std::size_t most_points_;
  frame::RangeImage image_;
  objects::ImageObjects objects_;
  std::vector<frame::Label> labels_;
};

}  // namespace terracut::points
