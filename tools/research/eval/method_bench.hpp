// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "frame_result.hpp"
#include "method_choice.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::eval {

/// Several methods side by side, sized for one shape of range image. One thread.
class MethodBench {
 public:
  /// Takes all memory from `memory`, which must outlive this object.
  MethodBench(std::span<const MethodChoice> methods, const mount::RingProfile& profile,
              const frame::ImageShape& shape, std::size_t return_capacity,
              memory::FixedMemory& memory);

  /// Labels with methods[index]; returns the times except decode_ns.
  [[nodiscard]] FrameTimes segment(std::size_t index, const frame::RangeImage& image);
  /// Returns the labels of that method, one per return, until it runs again.
  [[nodiscard]] std::span<const frame::Label> labels(std::size_t index) const;
  /// Returns the planes of that method, until it runs again.
  [[nodiscard]] const stage::CellPlanes& planes(std::size_t index) const;

 private:
  std::vector<std::unique_ptr<ground::FrameMethod>> methods_;
};

}  // namespace terracut::eval
