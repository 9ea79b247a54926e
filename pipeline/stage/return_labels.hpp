// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/frame/transpose.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::stage {

/// Last stage: labels of cells brought back to the returns, each return of the frame getting one
/// (docs/design.md, promise 1). A return that shares its cell with an earlier one takes that one's
/// label when it lies close to it, and is judged by its own height above the ground otherwise.
class ReturnLabels {
 public:
  struct Config {
    float same_surface_range_m = 0.30F;   ///< Close: no farther than this in horizontal range ...
    float same_surface_height_m = 0.10F;  ///< ... and this in height.
    float obstacle_height_m = 0.15F;      ///< Else an obstacle from this height on.
  };

  /// `return_capacity`: RangeImage::return_capacity() of the images to come.
  ReturnLabels(const Config& config, std::size_t return_capacity, memory::FixedMemory& memory);

  /// Labels every return of `image`. Real-time safe.
  void assign(const frame::RangeImage& image,
              const CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;

  /// The same of a frame whose returns are kept as they were measured. `points`: good at cells that
  /// several returns are in. `reader`: of the sensor.
  void assign(const frame::MeasuredReturns& returns, const frame::PointPlanes& points,
              frame::TileReader& reader, const CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;

  /// One label a return, in the order of RangeImage::return_index(); none is kNone.
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept {
    return labels_.first(returns_);
  }
  /// The same, for the stage that tells one ground from another.
  [[nodiscard]] std::span<frame::Label> mutable_labels() noexcept {
    return labels_.first(returns_);
  }

 private:
  /// Of a return that does not own its cell, by how far it is above and behind the one that does.
  [[nodiscard]] frame::Label label_of_extra(float above_owner_m, float behind_owner_m,
                                            std::size_t cell,
                                            const CellPlanes& planes) const noexcept;
  using TileLabels = frame::TileRow<std::uint8_t>;
  /// Labels of the returns of one laser in the tile that is open; kNone where it has none.
  [[nodiscard]] TileLabels labels_of_row(const frame::MeasuredReturns& returns, std::size_t tile,
                                         std::size_t laser, const frame::PointPlanes& points,
                                         frame::TileReader& reader,
                                         const CellPlanes& planes) const noexcept;

  Config config_;
  std::size_t returns_ = 0;
  std::span<frame::Label> labels_;
};

}  // namespace terracut::stage
