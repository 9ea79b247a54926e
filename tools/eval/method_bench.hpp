// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "calib/ring_profile.hpp"
#include "frame_result.hpp"
#include "method_choice.hpp"
#include "pipeline/range_image.hpp"
#include "rt/fixed_memory.hpp"

namespace terracut::evaluation {

/// Several methods side by side, sized for one kind of range image. One thread.
class MethodBench {
 public:
  /// Takes all memory, from `memory`, which must outlive this.
  MethodBench(std::span<const MethodChoice> methods, const calib::RingProfile& profile,
              const pipeline::ImageShape& shape, std::size_t return_capacity,
              rt::FixedMemory& memory);

  /// By methods[index]; the times without decode_ns.
  [[nodiscard]] FrameTimes segment(std::size_t index, const pipeline::RangeImage& image);
  /// What it found, a label a return, until it is asked again.
  [[nodiscard]] std::span<const pipeline::Label> labels(std::size_t index) const;

 private:
  std::vector<std::unique_ptr<pipeline::GroundMethod>> methods_;
};

}  // namespace terracut::evaluation
