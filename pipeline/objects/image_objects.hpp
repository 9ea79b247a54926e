// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/objects/object_finder.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::objects {

/// Finds the objects of an image whose labels and heights are known by return, not by cell. Takes
/// all memory in the constructor; the rest is as ObjectFinder.
class ImageObjects {
 public:
  /// The arguments are ObjectFinder's.
  ImageObjects(const mount::RingProfile& profile, frame::ImageShape shape,
               std::size_t return_capacity, memory::FixedMemory& memory)
      : planes_(shape, memory), finder_({}, profile, shape, return_capacity, memory) {}

  /// `labels` and `heights_m`, above the ground, have one element per return, by return index.
  /// Overwrites the last result. Real-time safe.
  void find(const frame::RangeImage& image, std::span<const frame::Label> labels,
            std::span<const float> heights_m) noexcept TERRACUT_NONBLOCKING;

  /// As of ObjectFinder.
  [[nodiscard]] std::span<const Object> objects() const noexcept { return finder_.objects(); }
  [[nodiscard]] std::span<const std::uint16_t> object_of_return() const noexcept {
    return finder_.object_of_return();
  }

 private:
  stage::CellPlanes planes_;
  ObjectFinder finder_;
};

}  // namespace terracut::objects
