// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stage/return_labels.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace terracut::stage {
namespace {

void copy_where_measured(const frame::Label* __restrict from, const std::uint16_t* __restrict raw,
                         std::uint8_t* __restrict to) noexcept {
  for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
    const auto mask = static_cast<std::uint8_t>(raw[f] != 0 ? 0xFF : 0);
    to[f] = static_cast<std::uint8_t>(static_cast<std::uint8_t>(from[f]) & mask);
  }
}

/// Writes the labels of a firing's returns, one after the other, and returns where the next one
/// goes. `of_firing` has kNone, which is 0, where there is no return.
frame::Label* write_labels(std::span<const std::uint8_t> of_firing, frame::Label* next) noexcept {
  static_assert(static_cast<int>(frame::Label::kNone) == 0);
  constexpr std::uint64_t kOnes = 0x0101'0101'0101'0101, kHighest = kOnes << 7U;
  for (std::size_t i = 0; i < of_firing.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t eight;
    std::memcpy(&eight, &of_firing[i], sizeof(eight));
    if (((eight - kOnes) & ~eight & kHighest) == 0) {
      std::memcpy(next, &eight, sizeof(eight));
      next += sizeof(eight);
      continue;
    }
    // A branch would be mispredicted. So each label is written, and the next one overwrites it if
    // it is kNone.
    for (; eight != 0; eight >>= 8U) {
      *next = static_cast<frame::Label>(eight & 0xFFU);
      next += (eight & 0xFFU) != 0 ? 1 : 0;
    }
  }
  return next;
}

}  // namespace

ReturnLabels::ReturnLabels(const Config& config, float obstacle_height_m,
                           std::size_t return_capacity, memory::FixedMemory& memory)
    : config_(config),
      obstacle_height_m_(obstacle_height_m),
      labels_(memory.take<frame::Label>("return labels", return_capacity + 1)) {}

void ReturnLabels::assign(const frame::RangeImage& image, const CellPlanes& planes) noexcept {
  returns_ = image.returns();
  const auto index = image.return_index();
  const std::size_t nowhere = labels_.size() - 1;
  for (std::size_t cell = 0; cell < planes.label.size(); ++cell) {
    // A branch would be mispredicted. So empty cells write their label, too, to a slot that nobody
    // reads.
    const frame::Label label = planes.label[cell];
    labels_[label != frame::Label::kNone ? index[cell] : nowhere] = label;
  }
  for (const frame::OverflowReturn& extra : image.overflow()) {
    labels_[extra.return_index] = label_of_extra(
        extra.point.z_m - image.z_m()[extra.cell],
        extra.point.ground_range_m - image.ground_range_m()[extra.cell], extra.cell, planes);
  }
}

frame::Label ReturnLabels::label_of_extra(float above_owner_m, float behind_owner_m,
                                          std::size_t cell,
                                          const CellPlanes& planes) const noexcept {
  const bool same_surface = std::fabs(behind_owner_m) < config_.same_surface_range_m &&
                            std::fabs(above_owner_m) < config_.same_surface_height_m;
  return same_surface ? planes.label[cell] : label_of(planes.height_m[cell] + above_owner_m);
}

bool ReturnLabels::write_tile(const frame::MeasuredReturns& turn, std::size_t tile,
                              const frame::PointPlanes& points, frame::TileReader& reader,
                              const CellPlanes& planes) noexcept {
  const std::size_t lasers = turn.lasers();
  const std::span<const std::int32_t> rows = reader.rows();
  const auto stride = static_cast<std::size_t>(turn.shape().stride());
  std::array<TileLabels, frame::MeasuredReturns::kMostLasers> of_laser;
  std::array<std::uint8_t, of_laser.size() * frame::kTileFirings> of_firing;
  const frame::MeasuredReturns::Tile& at = turn.tile(tile);
  const std::uint16_t* const raw = turn.raw(tile);
  const frame::MeasuredReturns::LaserRow* const of_tile = &turn.row(tile, 0);
  bool is_open = false;
  for (std::size_t i = 0; i < lasers; ++i) {
    const frame::MeasuredReturns::LaserRow& row = of_tile[i];
    if (row.is_run && row.owned == row.returns) {
      const std::size_t cell =
          static_cast<std::size_t>(rows[i]) * stride + static_cast<std::size_t>(row.least);
      if (row.returns == frame::kAllFirings) {
        std::memcpy(of_laser[i].data(), &planes.label[cell], frame::kTileFirings);
      } else {
        copy_where_measured(&planes.label[cell], raw + i * frame::kTileFirings, of_laser[i].data());
      }
      continue;
    }
    if (row.owned != row.returns && !std::exchange(is_open, true)) {
      reader.open(at.heads, turn.distances(tile));
    }
    of_laser[i] = labels_of_row(turn, tile, i, points, reader, planes);
  }
  frame::transpose(of_laser[0].data(), lasers, frame::kTileFirings, of_firing.data());
  returns_ = turn.end_of(tile);
  bool is_whole = true;
  for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
    const frame::Label* const next =
        write_labels({&of_firing[f * lasers], lasers}, &labels_[at.first_return[f]]);
    const std::size_t last = f + 1 < frame::kTileFirings ? at.first_return[f + 1] : returns_;
    is_whole &= next == labels_.data() + last;
  }
  return is_whole;
}

ReturnLabels::TileLabels ReturnLabels::labels_of_row(const frame::MeasuredReturns& turn,
                                                     std::size_t tile, std::size_t laser,
                                                     const frame::PointPlanes& points,
                                                     frame::TileReader& reader,
                                                     const CellPlanes& planes) const noexcept {
  TileLabels labels{};
  const frame::MeasuredReturns::LaserRow& row = turn.row(tile, laser);
  if (row.returns == 0) return labels;
  frame::TilePoints extra;
  if (row.owned != row.returns) reader.compute_points(laser, all_of(extra));
  const std::size_t first = turn.shape().cell(reader.rows()[laser], 0);
  const frame::Label* const owners = &planes.label[first];
  const frame::TileRow<std::uint16_t> columns = turn.columns(tile, laser);
  frame::for_each_firing(row.returns, [&](std::size_t f) noexcept {
    labels[f] = static_cast<std::uint8_t>(owners[columns[f]]);
  });
  frame::for_each_firing(row.returns & ~row.owned, [&](std::size_t f) noexcept {
    const std::size_t cell = first + columns[f];
    labels[f] = static_cast<std::uint8_t>(
        label_of_extra(extra.z_m[f] - points.z_m[cell],
                       extra.ground_range_m[f] - points.ground_range_m[cell], cell, planes));
  });
  return labels;
}

}  // namespace terracut::stage
