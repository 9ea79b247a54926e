// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/frame/point_planes.hpp"

namespace terracut::test {

/// A reader that keeps the open tile as it is, for tests that make points of it in their own way.
template <std::size_t Lasers>
class HeldTileReader : public frame::TileReader {
 public:
  void open(const frame::TileHeads& heads,
            const frame::TileDistances& distances) noexcept TERRACUT_NONBLOCKING final {
    heads_ = heads;
    raw_ = distances.raw;
  }
  [[nodiscard]] std::span<const std::int32_t> rows() const noexcept TERRACUT_NONBLOCKING final {
    return rows_;
  }

 protected:
  explicit HeldTileReader(const std::array<std::int32_t, Lasers>& rows) : rows_(rows) {}

  [[nodiscard]] std::uint16_t raw(std::size_t laser, std::size_t firing) const noexcept {
    return raw_[laser * frame::kTileFirings + firing];
  }

  frame::TileHeads heads_{};
  std::array<std::int32_t, Lasers> rows_;

 private:
  const std::uint16_t* raw_ = nullptr;
};

inline constexpr std::size_t kPlainLasers = 8;

/// Points that tell where they were measured: x is the wire distance, y the head's azimuth, z the
/// laser; the range is x. Laser i is of row 7 - i.
class PlainReader final : public HeldTileReader<kPlainLasers> {
 public:
  PlainReader() : HeldTileReader({7, 6, 5, 4, 3, 2, 1, 0}) {}

  void compute_points(std::size_t laser,
                      const frame::PointsOut& out) noexcept TERRACUT_NONBLOCKING override {
    for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
      const auto distance = static_cast<float>(raw(laser, f));
      out.x_m[f] = out.ground_range_m[f] = distance;
      out.y_m[f] = static_cast<float>(heads_.head_cdeg[f]);
      out.z_m[f] = distance == 0 ? frame::kNoHeight_m : static_cast<float>(laser);
    }
  }
  void set_row(std::size_t laser, std::int32_t row) { rows_[laser] = row; }
};

/// One tile, of which nothing was measured yet.
struct PlainTile {
  std::array<frame::TileRow<std::uint16_t>, kPlainLasers> raw{};
  std::array<frame::TileRow<std::uint8_t>, kPlainLasers> intensity{};
  std::array<frame::BeamColumns, kPlainLasers> beams{};
  frame::TileHeads heads{};

  explicit PlainTile(std::int32_t first_column) {
    for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
      const std::int32_t column = first_column + static_cast<std::int32_t>(f);
      heads.head_cdeg[f] = column;
      for (frame::BeamColumns& beam : beams) beam.column[f] = column;
    }
    settle();
  }
  /// After a change of columns.
  void settle() {
    for (frame::BeamColumns& beam : beams) {
      const auto [least, most] = std::ranges::minmax(beam.column);
      beam.least = least;
      beam.most = most;
      beam.is_one_run = true;
      for (std::size_t f = 1; f < frame::kTileFirings; ++f) {
        beam.is_one_run &= beam.column[f] == beam.column[f - 1] + 1;
      }
    }
  }
  /// Adds it to a frame; how many returns found no room.
  std::uint32_t add_to(frame::MeasuredReturns& returns, frame::TileReader& reader,
                       frame::CellOwner owner = frame::CellOwner::kFirstArrived,
                       std::int32_t first_column = 0) const {
    return returns.add({.heads = heads,
                        .distances = {raw[0].data()},
                        .intensity = intensity[0].data(),
                        .beams = beams,
                        .first_column = first_column},
                       owner, reader);
  }
};

}  // namespace terracut::test
