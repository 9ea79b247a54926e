// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <span>
#include <vector>

#include "pipeline/status/frame_record.hpp"
#include "pipeline/stream/labelled_frame_wire.hpp"
#include "rt/memory/used_again.hpp"
#include "terracut/frame.hpp"

namespace terracut::python {

/// One labelled frame, or a sector of one, whose numpy arrays are views of `points` and keep it
/// alive.
struct FrameData {
  frame::FrameInfo info;
  std::uint32_t first_return = 0;             ///< Place in the frame of a sector's first return.
  std::optional<status::FrameRecord> record;  ///< Record of the frame; none for a live run.
  std::vector<stream::WirePoint> points;
  std::vector<float> heights_m;  ///< Heights above the ground; empty unless asked for.
  /// Objects, and the number of each point's object; none unless asked for.
  std::optional<std::vector<Object>> objects;
  std::vector<std::uint16_t> object_of_point;
  std::optional<std::vector<CompleteObject>> complete_objects;  ///< Of a sector; as `objects`.
  std::optional<std::vector<FreeWaySector>> free_way;           ///< None unless asked for.

  void set_objects(std::span<const Object> found, std::span<const std::uint16_t> numbers) {
    objects.emplace(found.begin(), found.end());
    object_of_point.assign(numbers.begin(), numbers.end());
  }
};

/// Reuses the memory of frames once Python has dropped the last array that refers to them.
using FrameBuffers = memory::UsedAgain<FrameData>;

void bind_frame(pybind11::module_& module);

}  // namespace terracut::python
