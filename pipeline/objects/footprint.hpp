// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>

#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/objects/object.hpp"
#include "pipeline/objects/run.hpp"
#include "pipeline/stage/float_lanes.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::objects {

/// The outermost of some returns in 16 directions.
class Outermost {
 public:
  /// Begins with one return.
  void begin(const frame::PointPlanes& points, std::uint32_t cell) noexcept TERRACUT_NONBLOCKING;
  /// Adds the returns of a run of that extent.
  void add(const frame::PointPlanes& points, const Run& run,
           const Extent& extent) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] Footprint footprint(const frame::PointPlanes& points) const noexcept
      TERRACUT_NONBLOCKING;

 private:
  static constexpr std::size_t kAxes = 8, kHalves = 2;
  using Ways = std::array<stage::FourFloats, kHalves>;  ///< Of a return along each axis, metres.

  /// True if some place between these coordinates would be outermost.
  [[nodiscard]] bool exceed(const Extent& extent) const noexcept;
  void add(const frame::PointPlanes& points, std::uint32_t cell) noexcept;

  Ways least_, most_;
  std::array<std::uint32_t, kAxes> least_at_, most_at_;
};

/// Returns the rectangle of least area that has a side along a side of the footprint.
[[nodiscard]] Box box_around(const Footprint& footprint) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::objects
