// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
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

  // The returns of a turn can be labelled tile by tile, in order of arrival.

  /// Begins a turn.
  void begin() noexcept { returns_ = 0; }
  /// Labels the returns of a turn's next tile, whose cells must have their final labels. `points`
  /// must be valid there; `reader` is the sensor's. A return that came late, after its empty cell
  /// was labelled, is judged by `height_of(column, z_m, ground_range_m)`, its height above the
  /// ground. Returns the number of such returns.
  template <class HeightOf>
  std::uint32_t assign_tile(const frame::MeasuredReturns& turn, std::size_t tile,
                            const frame::PointPlanes& points, frame::TileReader& reader,
                            const CellPlanes& planes, HeightOf height_of) noexcept {
    if (write_tile(turn, tile, points, reader, planes)) return 0;
    return write_late_tile(turn, tile, points, reader, planes, height_of);
  }

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
  [[nodiscard]] frame::Label label_of(float height_m) const noexcept {
    return height_m < obstacle_height_m_ ? frame::Label::kGround : frame::Label::kObstacle;
  }
  using TileLabels = frame::TileRow<std::uint8_t>;
  /// Returns the labels of one laser's returns in the open tile; kNone for a missing return.
  [[nodiscard]] TileLabels labels_of_row(
      const frame::MeasuredReturns& turn, std::size_t tile, std::size_t laser,
      const frame::PointPlanes& points, frame::TileReader& reader,
      const CellPlanes& planes) const noexcept TERRACUT_NONBLOCKING;
  /// Returns false if a return of the tile has no label because its cell has none.
  [[nodiscard]] bool write_tile(const frame::MeasuredReturns& turn, std::size_t tile,
                                const frame::PointPlanes& points, frame::TileReader& reader,
                                const CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;
  template <class HeightOf>
  std::uint32_t write_late_tile(const frame::MeasuredReturns& turn, std::size_t tile,
                                const frame::PointPlanes& points, frame::TileReader& reader,
                                const CellPlanes& planes, HeightOf height_of) noexcept;

  Config config_;
  float obstacle_height_m_;
  std::size_t returns_ = 0;
  std::span<frame::Label> labels_;
};

template <class HeightOf>
std::uint32_t ReturnLabels::write_late_tile(const frame::MeasuredReturns& turn, std::size_t tile,
                                            const frame::PointPlanes& points,
                                            frame::TileReader& reader, const CellPlanes& planes,
                                            HeightOf height_of) noexcept {
  std::uint32_t late = 0;
  frame::TileRow<std::uint32_t> next = turn.tile(tile).first_return;
  reader.open(turn.tile(tile).heads, turn.distances(tile));
  for (std::size_t i = 0; i < turn.lasers(); ++i) {
    frame::TilePoints own;
    reader.compute_points(i, all_of(own));
    const TileLabels labels = labels_of_row(turn, tile, i, points, reader, planes);
    frame::for_each_firing(turn.row(tile, i).returns, [&](std::size_t f) noexcept {
      auto label = static_cast<frame::Label>(labels[f]);
      if (label == frame::Label::kNone) {
        ++late;
        label = label_of(height_of(turn.column(tile, i, f), own.z_m[f], own.ground_range_m[f]));
      }
      labels_[next[f]++] = label;
    });
  }
  return late;
}

}  // namespace terracut::stage
