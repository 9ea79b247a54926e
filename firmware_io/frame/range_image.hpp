// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "firmware_io/frame/cell_owner.hpp"
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

/// Rigid motions in the ground plane, one per column: x' = c x - s y + t_x, y' = s x + c y + t_y.
struct PlanarMotions {
  std::span<const float> cosine, sine, x_m, y_m;
};

/// One frame of returns as an image: structure of arrays, rows x columns, row-major with stride
/// `shape().stride()`, cyclic in columns. Fixed memory; no operation here allocates.
///
/// A cell without a return has a NaN height, so that every comparison with it is false; its other
/// planes hold old values. The padding cells (column >= columns) never hold a return.
///
/// Thread contract: one writer until the frame is handed over, then readers only.
class RangeImage {
 public:
  /// `overflow_capacity` is the number of returns beyond one per cell that a frame may have.
  RangeImage(ImageShape shape, std::size_t overflow_capacity, memory::FixedMemory& memory);
  /// Makes an image that keeps returns as measured, not as points: its planes and overflow list are
  /// empty, and place() is not used.
  RangeImage(ImageShape shape, MeasuredReturns measured) noexcept;

  /// Returns the measured returns; null if the image keeps points.
  [[nodiscard]] MeasuredReturns* measured() noexcept { return measured_ ? &*measured_ : nullptr; }
  [[nodiscard]] const MeasuredReturns* measured() const noexcept {
    return measured_ ? &*measured_ : nullptr;
  }
  /// Returns all points; only valid if measured() is null.
  [[nodiscard]] PointPlanes points() const noexcept {
    return {x_m_.data(), y_m_.data(), z_m_.data(), ground_range_m_.data()};
  }

  /// Removes all returns. Real-time safe.
  void clear() noexcept TERRACUT_NONBLOCKING;

  /// Puts a return into its cell. If the cell is taken, `owner` says which of the two returns keeps
  /// it (the earlier if equal); the other goes to the overflow list. Returns are numbered in the
  /// order of these calls. Returns false if the overflow list is full: the return is not kept, and
  /// the caller must count it. row in [0, rows), column in [0, columns); coordinates are not NaN.
  /// Real-time safe.
  bool place(int row, int column, const Return& point,
             CellOwner owner = CellOwner::kFirstArrived) noexcept {
    if (!place_numbered(row, column, point, owner, returns_)) return false;
    ++returns_;
    return true;
  }

  // The next functions place returns out of order: take_numbers() first gives the returns their
  // numbers, then they are placed in any order.

  /// True if the overflow list has room for `count` more returns.
  [[nodiscard]] bool has_room_for(std::size_t count) const noexcept {
    return overflow_.size() - overflow_used_ >= count;
  }
  /// Takes the next `count` numbers and returns the first.
  [[nodiscard]] std::uint32_t take_numbers(std::uint32_t count) noexcept {
    return std::exchange(returns_, returns_ + count);
  }
  /// Places a return that already has a number, as place() does.
  bool place_numbered(int row, int column, const Return& point, CellOwner owner,
                      std::uint32_t number) noexcept {
    const std::size_t cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(stride_) +
                             static_cast<std::size_t>(column);
    if (has_return(cell)) [[unlikely]]
      return place_second(cell, point, owner, number);
    write(cell, point, number);
    empty_from_[static_cast<std::size_t>(row)] =
        std::max(empty_from_[static_cast<std::size_t>(row)], column + 1);
    return true;
  }

  /// True if the row has no return in `column` or after it.
  [[nodiscard]] bool is_empty_from(int row, int column) const noexcept {
    return empty_from_[static_cast<std::size_t>(row)] <= column;
  }
  /// Pointers into the planes at one cell.
  struct Cells {
    float *x_m, *y_m, *z_m, *ground_range_m;
    std::uint8_t* intensity;
    std::uint32_t* return_index;
  };
  /// Returns the cells for `count` adjacent returns whose numbers were taken; the caller fills
  /// them. The row must be is_empty_from() the first column. A cell without a return gets a NaN
  /// height.
  [[nodiscard]] Cells take_cells(int row, int column, int count) noexcept {
    empty_from_[static_cast<std::size_t>(row)] = column + count;
    const std::size_t cell = shape_.cell(row, column);
    return {&x_m_[cell],       &y_m_[cell],         &z_m_[cell], &ground_range_m_[cell],
            &intensity_[cell], &return_index_[cell]};
  }
  /// Prefetches the cells of a row that will be written after those of all other rows: about one
  /// and a half cache lines from `column` on. Three frames do not fit the caches next to a core.
  void fetch_to_write(int row, int column) const noexcept {
    constexpr std::size_t kLineBytes = 64;
    const std::size_t cell = shape_.cell(row, column);
    for (const Plane& plane : planes_) {
      const std::byte* next = plane.begin + cell * plane.cell_bytes;
      __builtin_prefetch(next, 1, 2);
      __builtin_prefetch(next + kLineBytes, 1, 2);
    }
  }

  /// Moves each return by the motion of its row and column; cells and heights stay. `by_row` has
  /// one element per row. Real-time safe.
  void move(std::span<const PlanarMotions> by_row) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] const ImageShape& shape() const noexcept { return shape_; }
  /// Returns a number that changes with every clear().
  [[nodiscard]] std::uint32_t generation() const noexcept { return generation_; }
  [[nodiscard]] bool has_return(std::size_t cell) const noexcept { return !std::isnan(z_m_[cell]); }
  /// Returns the number of returns placed since clear(), overflow list included.
  [[nodiscard]] std::uint32_t returns() const noexcept {
    return measured_ ? measured_->returns() : returns_;
  }
  /// Returns the most returns a frame may have: cells + overflow capacity.
  [[nodiscard]] std::size_t return_capacity() const noexcept {
    return measured_ ? measured_->return_capacity() : shape_.cells() + overflow_.size();
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
  struct Plane {
    const std::byte* begin;
    std::size_t cell_bytes;
  };

  [[nodiscard]] bool owns(std::size_t cell, const Return& point,
                          CellOwner owner) const noexcept TERRACUT_NONBLOCKING;
  bool place_second(std::size_t cell, const Return& point, CellOwner owner,
                    std::uint32_t number) noexcept TERRACUT_NONBLOCKING;

  ImageShape shape_;
  int stride_;
  std::uint32_t generation_ = 1;
  std::uint32_t returns_ = 0;
  std::size_t overflow_used_ = 0;
  std::span<float> x_m_, y_m_, z_m_, ground_range_m_;
  std::span<std::uint8_t> intensity_;
  std::span<std::uint32_t> return_index_;
  std::span<OverflowReturn> overflow_;
  std::span<std::int32_t> empty_from_;  ///< First column from which each row is empty.
  std::array<Plane, 6> planes_{};
  std::optional<MeasuredReturns> measured_;
};

}  // namespace terracut::frame
