// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ring_elevation_map.hpp"

#include <algorithm>
#include <limits>

namespace terracut::pipeline {
namespace {

/// Applies `reference_m(cell, sector)` to every return: its height above it, and the label it
/// earns.
template <class Reference>
void label_by_height(const RangeImage& image, const RingGrid& grid, float obstacle_height_m,
                     CellPlanes& planes, Reference reference_m) noexcept {
  const ImageShape& shape = image.shape();
  const auto z_m = image.z_m();
  for (int row = 0; row < shape.rows; ++row) {
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(shape.stride());
    for (int column = 0; column < shape.stride(); ++column) {
      const std::size_t cell = first + static_cast<std::size_t>(column);
      if (!image.has_return(cell)) {
        planes.height_m[cell] = std::numeric_limits<float>::quiet_NaN();
        planes.label[cell] = Label::kNone;
        continue;
      }
      const float height_m = z_m[cell] - reference_m(cell, grid.sector_of(column));
      planes.height_m[cell] = height_m;
      planes.label[cell] = height_m < obstacle_height_m ? Label::kGround : Label::kObstacle;
    }
  }
}

}  // namespace

RingElevationMap::RingElevationMap(const Config& config, const calib::RingProfile& profile,
                                   ImageShape shape, rt::FixedMemory& memory)
    : config_(config),
      grid_(config.grid, profile, shape, memory),
      surface_(config.surface, grid_, memory),
      lowest_(memory.take<GroundSurface::LowestReturn>("ring grid", grid_.cells())) {}

void RingElevationMap::segment(const RangeImage& image, CellPlanes& planes) noexcept {
  find_lowest_returns(image);
  if (config_.reference == GroundReference::kCellMinimum) {
    label_by_cell_minimum(image, planes);
    return;
  }
  surface_.estimate(grid_, lowest_);
  label_by_local_surface(image, planes);
}

void RingElevationMap::find_lowest_returns(const RangeImage& image) noexcept {
  std::fill(lowest_.begin(), lowest_.end(), GroundSurface::LowestReturn{});
  const auto lower = [this](int sector, float range_m, float height_m) noexcept {
    GroundSurface::LowestReturn& lowest = lowest_[grid_.cell(sector, grid_.band_of(range_m))];
    if (height_m < lowest.height_m) lowest = {height_m, range_m};
  };
  const ImageShape& shape = image.shape();
  const auto z_m = image.z_m();
  const auto ground_range_m = image.ground_range_m();
  for (int row = 0; row < shape.rows; ++row) {
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(shape.stride());
    for (int column = 0; column < shape.columns; ++column) {
      const std::size_t cell = first + static_cast<std::size_t>(column);
      if (!image.has_return(cell)) continue;
      lower(grid_.sector_of(column), ground_range_m[cell], z_m[cell]);
    }
  }
  for (const OverflowReturn& extra : image.overflow()) {
    const int column = static_cast<int>(extra.cell % static_cast<std::uint32_t>(shape.stride()));
    lower(grid_.sector_of(column), extra.echo.ground_range_m, extra.echo.z_m);
  }
}

void RingElevationMap::label_by_cell_minimum(const RangeImage& image,
                                             CellPlanes& planes) const noexcept {
  const auto ground_range_m = image.ground_range_m();
  label_by_height(
      image, grid_, config_.obstacle_height_m, planes, [&](std::size_t cell, int sector) {
        return lowest_[grid_.cell(sector, grid_.band_of(ground_range_m[cell]))].height_m;
      });
}

void RingElevationMap::label_by_local_surface(const RangeImage& image,
                                              CellPlanes& planes) const noexcept {
  const auto ground_range_m = image.ground_range_m();
  const auto surface_m = surface_.height_m();
  label_by_height(image, grid_, config_.obstacle_height_m, planes,
                  [&](std::size_t cell, int sector) {
                    const RingGrid::BandMix& mix = grid_.mix_of(ground_range_m[cell]);
                    const float inner_m = surface_m[grid_.cell(sector, mix.inner)];
                    const float outer_m = surface_m[grid_.cell(sector, mix.outer)];
                    return inner_m + mix.outer_share * (outer_m - inner_m);
                  });
}

}  // namespace terracut::pipeline
