// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/cell_owner.hpp"
#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::frame {

/// One return in the vehicle frame (calib/mount/mount.hpp).
struct Return {
  float x_m = 0, y_m = 0;
  float z_m = 0;             ///< Height above the mount's ground plane.
  float ground_range_m = 0;  ///< Horizontal distance from the frame's origin, sqrt(x^2 + y^2).
  std::uint8_t intensity = 0;
};

/// A return whose cell is owned by another return (dual return, two firings in a column).
struct OverflowReturn {
  Return point;
  std::uint32_t cell = 0;          ///< Index of the shared cell, row * stride + column.
  std::uint32_t return_index = 0;  ///< See RangeImage::return_index().
};

/// One frame of returns as an image of points: structure of arrays, rows x columns, row-major with
/// stride `shape().stride()`, cyclic in columns. Made of a cloud's points, place() by place(), or
/// of a decoded frame, by fill(). Fixed memory; no operation here allocates.
///
/// A cell without a return has a NaN height, so that every comparison with it is false; its other
/// planes hold old values. The padding cells (column >= columns) never hold a return.
///
/// Thread contract: one writer until the frame is handed over, then readers only.
class RangeImage {
 public:
  /// `overflow_capacity` is the number of returns beyond one per cell that a frame may have.
  RangeImage(ImageShape shape, std::size_t overflow_capacity, memory::FixedMemory& memory);

  /// Returns all points.
  [[nodiscard]] PointPlanes points() const noexcept {
    return {x_m_.data(), y_m_.data(), z_m_.data(), ground_range_m_.data()};
  }

  /// Removes all returns. Real-time safe.
  void clear() noexcept TERRACUT_NONBLOCKING;

  /// Puts a return into its cell. If the cell is taken, `owner` says which of the two returns keeps
  /// it (the earlier if equal); the other goes to the overflow list. Returns are numbered in the
  /// order of these calls. Returns false if the overflow list is full: the return is not kept, and
  /// the caller must count it. row in [0, rows), column in [0, columns); coordinates are not NaN,
  /// but a height may be: such a return takes a number and no cell. Real-time safe.
  bool place(int row, int column, const Return& point,
             CellOwner owner = CellOwner::kFirstArrived) noexcept {
    const std::size_t cell = shape_.cell(row, column);
    if (!has_return(cell)) {
      write(cell, point, returns_);
    } else if (!place_second(cell, point, owner)) [[unlikely]] {
      return false;
    }
    ++returns_;
    return true;
  }
  /// Replaces all returns by those of a decoded frame: same cells, owners and numbers. The overflow
  /// list must have room for `measured.return_capacity()`. `reader` is the sensor's; any tile open
  /// in it is closed. Real-time safe.
  void fill(const MeasuredReturns& measured, TileReader& reader) noexcept TERRACUT_NONBLOCKING;

  /// Moves each return by the motion of its row and column; cells and heights stay. `by_row` has
  /// one element per row, or is empty. Real-time safe.
  void move(std::span<const PlanarMotions> by_row) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] const ImageShape& shape() const noexcept { return shape_; }
  [[nodiscard]] bool has_return(std::size_t cell) const noexcept { return !std::isnan(z_m_[cell]); }
  /// Returns the number of returns placed since clear(), overflow list included.
  [[nodiscard]] std::uint32_t returns() const noexcept { return returns_; }
  /// Returns the most returns a frame may have: cells + overflow capacity.
  [[nodiscard]] std::size_t return_capacity() const noexcept {
    return shape_.cells() + overflow_.size();
  }

  [[nodiscard]] std::span<const float> x_m() const noexcept { return x_m_; }
  [[nodiscard]] std::span<const float> y_m() const noexcept { return y_m_; }
  [[nodiscard]] std::span<const float> z_m() const noexcept { return z_m_; }
  [[nodiscard]] std::span<const float> ground_range_m() const noexcept { return ground_range_m_; }
  [[nodiscard]] std::span<const std::uint8_t> intensity() const noexcept { return intensity_; }
  /// Returns for each cell the number of its return in the frame, from 0 in order of arrival.
  [[nodiscard]] std::span<const std::uint32_t> return_index() const noexcept {
    return return_index_;
  }
  [[nodiscard]] std::span<const OverflowReturn> overflow() const noexcept {
    return overflow_.first(overflow_used_);
  }

 private:
  void write(std::size_t cell, const Return& point, std::uint32_t return_index) noexcept {
    x_m_[cell] = point.x_m;
    y_m_[cell] = point.y_m;
    z_m_[cell] = point.z_m;
    ground_range_m_[cell] = point.ground_range_m;
    intensity_[cell] = point.intensity;
    return_index_[cell] = return_index;
  }
  /// Writes a laser's returns of the open tile; `numbers` has each firing's next number.
  void fill_row(const MeasuredReturns& measured, std::size_t tile, std::size_t laser,
                TileReader& reader, TileRow<std::uint32_t>& numbers) noexcept;
  /// Prefetches about one and a half cache lines of each plane.
  void fetch_to_write(std::size_t cell) const noexcept;

  [[nodiscard]] bool owns(std::size_t cell, const Return& point,
                          CellOwner owner) const noexcept TERRACUT_NONBLOCKING;
  bool place_second(std::size_t cell, const Return& point,
                    CellOwner owner) noexcept TERRACUT_NONBLOCKING;

  ImageShape shape_;
  std::uint32_t returns_ = 0;
  std::size_t overflow_used_ = 0;
  std::span<float> x_m_, y_m_, z_m_, ground_range_m_;
  std::span<std::uint8_t> intensity_;
  std::span<std::uint32_t> return_index_;
  std::span<OverflowReturn> overflow_;
};

}  // namespace terracut::frame
