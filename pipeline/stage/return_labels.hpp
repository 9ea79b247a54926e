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

/// The last stage: labels every return of the frame from the labels of the cells (docs/design.md,
/// promise 1). A return that does not own its cell takes the label of the owner if it is close to
/// the owner; otherwise its own height above the ground decides.
class ReturnLabels {
 public:
  struct Config {
    float same_surface_range_m = 0.30F;   ///< Returns farther apart in range are not close.
    float same_surface_height_m = 0.10F;  ///< Returns farther apart in height are not close.
  };

  /// A return that is not close to its cell's owner is an obstacle if it lies at least
  /// `obstacle_height_m` above the ground. `return_capacity` is RangeImage::return_capacity() of
  /// the images to be labelled.
  ReturnLabels(const Config& config, float obstacle_height_m, std::size_t return_capacity,
               memory::FixedMemory& memory);

  /// Labels every return of `image`. Real-time safe.
  void assign(const frame::RangeImage& image,
              const CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;

  /// Labels every return of a decoded frame. `points` must be valid in cells with several returns.
  /// `reader` is the sensor's tile reader.
  void assign(const frame::MeasuredReturns& returns, const frame::PointPlanes& points,
              frame::TileReader& reader, const CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;

  /// Returns one label per return, in the order of RangeImage::return_index(); never kNone.
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept {
    return labels_.first(returns_);
  }
  /// Returns the labels for a later stage that separates road from other ground.
  [[nodiscard]] std::span<frame::Label> mutable_labels() noexcept {
    return labels_.first(returns_);
  }

 private:
  /// Returns the label of a return that does not own its cell, by how far the return lies above and
  /// behind the cell's owner.
  [[nodiscard]] frame::Label label_of_extra(float above_owner_m, float behind_owner_m,
                                            std::size_t cell,
                                            const CellPlanes& planes) const noexcept;
  using TileLabels = frame::TileRow<std::uint8_t>;
  /// Returns the labels of one laser's returns in the open tile; kNone for a missing return.
  [[nodiscard]] TileLabels labels_of_row(const frame::MeasuredReturns& returns, std::size_t tile,
                                         std::size_t laser, const frame::PointPlanes& points,
                                         frame::TileReader& reader,
                                         const CellPlanes& planes) const noexcept;

  Config config_;
  float obstacle_height_m_;
  std::size_t returns_ = 0;
  std::span<frame::Label> labels_;
};

}  // namespace terracut::stage
