// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sector_sight.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_io/frame/point_distance.hpp"

namespace terracut::visibility {
namespace {

using frame::Label;

/// What hangs in the air is nearer and higher than this, and this far from any other return; and so
/// many rows, where these lie farther apart there: a pole of which one beam is missed is no drop.
constexpr float kAirNearest_m = 20, kAirLowest_m = 0.3F, kAlone_m = 0.6F;
constexpr double kAlone_rows = 2;
/// The view ends where so many rows, one above the other, are lost; a single laser may have failed.
constexpr int kLostRows = 2;
/// A row is judged by a sector's beams if at least one in so many used to return.
constexpr int kJudgedOneIn = 4;

float share(int part, int of) noexcept {
  return of == 0 ? 0.0F : static_cast<float>(part) / static_cast<float>(of);
}

std::uint8_t one_more(std::uint8_t count) noexcept {
  return static_cast<std::uint8_t>(count + (count < 255 ? 1 : 0));
}

/// Returns the angle between a row and the one above it.
double gap_rad(const mount::RingProfile& profile, std::size_t row) noexcept {
  return profile.rings[row + 1].elevation_rad - profile.rings[row].elevation_rad;
}

}  // namespace

SectorSights::SectorSights(const mount::RingProfile& profile, frame::ImageShape shape,
                           memory::FixedMemory& memory)
    : shape_(shape),
      ground_m_(memory.take<float>("visibility", profile.rings.size())),
      alone_by_range_(memory.take<float>("visibility", profile.rings.size())),
      beams_(memory.take<Beam>("visibility", shape.cells())),
      sectors_(memory.take<SectorSight>("visibility", kSectors)) {
  for (std::size_t row = 0; row < profile.rings.size(); ++row) {
    const double ground_m = profile.rings[row].ground_distance_m;
    ground_m_[row] = static_cast<float>(ground_m);
    const double above_rad = row + 1 < profile.rings.size() ? gap_rad(profile, row) : 0;
    const double below_rad = row > 0 ? gap_rad(profile, row - 1) : 0;
    alone_by_range_[row] = static_cast<float>(kAlone_rows * std::max(above_rad, below_rad));
    if (ground_m < kNear_m) near_rows_ = static_cast<int>(row) + 1;
    if (ground_m < kFarthest_m) ground_rows_ = static_cast<int>(row) + 1;
  }
}

void SectorSights::forget() noexcept {
  std::ranges::fill(beams_, Beam{});
}

std::span<const SectorSight> SectorSights::look(const frame::RangeImage& image,
                                                const stage::CellPlanes& planes) noexcept {
  const auto edge = [&](std::size_t sector) {
    return static_cast<int>(sector * static_cast<std::size_t>(shape_.columns) / kSectors);
  };
  for (std::size_t i = 0; i < kSectors; ++i) {
    sectors_[i] = look_at({edge(i), edge(i + 1)}, image, planes);
  }
  return sectors_;
}

SectorSight SectorSights::look_at(frame::ColumnRange columns, const frame::RangeImage& image,
                                  const stage::CellPlanes& planes) noexcept {
  int returned = 0, far = 0, alone = 0, lost_rows = 0;
  RowCount near;
  float visible_m = 0;
  for (int row = 0; row < shape_.rows; ++row) {
    for (int column = columns.begin; column < columns.end; ++column) {
      const std::size_t cell = shape_.cell(row, column);
      const Label label = planes.label[cell];
      const float range_m = image.ground_range_m()[cell], height_m = planes.height_m[cell];
      const int is_there = label != Label::kNone ? 1 : 0;
      returned += is_there;
      far += is_there & (range_m > kFar_m ? 1 : 0);
      const bool is_in_air =
          label == Label::kObstacle && height_m > kAirLowest_m && range_m < kAirNearest_m;
      if (is_in_air && is_alone(row, column, image)) ++alone;
    }
    if (row >= ground_rows_) continue;
    const RowCount of_row = look_at_beams(row, columns, planes);
    if (row < near_rows_) {
      near.usual += of_row.usual;
      near.lost += of_row.lost;
      near.stuck += of_row.stuck;
    }
    const bool is_judged = kJudgedOneIn * of_row.usual >= static_cast<int>(columns.size());
    if (is_judged && lost_rows < kLostRows) {
      lost_rows = 2 * of_row.lost <= of_row.usual ? 0 : lost_rows + 1;
      if (lost_rows == 0) visible_m = ground_m_[static_cast<std::size_t>(row)];
    }
  }
  const int beams = static_cast<int>(columns.size()) * shape_.rows;
  return {.visible_m = visible_m,
          .lost = share(near.lost, near.usual),
          .stuck = share(near.stuck, near.usual),
          .returned = share(returned, beams),
          .far = share(far, beams),
          .alone = share(alone, beams)};
}

SectorSights::RowCount SectorSights::look_at_beams(int row, frame::ColumnRange columns,
                                                   const stage::CellPlanes& planes) noexcept {
  RowCount count;
  for (int column = columns.begin; column < columns.end; ++column) {
    const std::size_t cell = shape_.cell(row, column);
    Beam& beam = beams_[cell];
    const bool is_there = planes.label[cell] != Label::kNone;
    beam.returned = is_there ? one_more(beam.returned) : std::uint8_t{0};
    beam.lost = is_there ? std::uint8_t{0} : one_more(beam.lost);
    beam.is_usual |= beam.returned >= kUsualTurns;
    count.usual += beam.is_usual ? 1 : 0;
    count.lost += beam.is_usual && !is_there ? 1 : 0;
    count.stuck += beam.is_usual && beam.lost >= kStuckTurns ? 1 : 0;
  }
  return count;
}

bool SectorSights::is_alone(int row, int column, const frame::RangeImage& image) const noexcept {
  const frame::PointPlanes points = image.points();
  const std::size_t cell = shape_.cell(row, column);
  const float reach_m = std::max(
      kAlone_m, alone_by_range_[static_cast<std::size_t>(row)] * image.ground_range_m()[cell]);
  for (int other_row = std::max(row - 1, 0); other_row <= std::min(row + 1, shape_.rows - 1);
       ++other_row) {
    for (const int aside : {-1, 0, 1}) {
      if (other_row == row && aside == 0) continue;
      const int other_column = (column + aside + shape_.columns) % shape_.columns;
      const std::size_t other = shape_.cell(other_row, other_column);
      // False for a cell without a return.
      if (distance_squared_m2(points, cell, other) < reach_m * reach_m) return false;
    }
  }
  return true;
}

}  // namespace terracut::visibility
