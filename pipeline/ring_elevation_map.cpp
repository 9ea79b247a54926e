// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ring_elevation_map.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "rt/vector_clones.hpp"

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

// Heights and ranges as whole numbers: the smaller the lower, among equally low ones the nearer.
// What is lowest is as good as random, and the least of numbers is found without a branch.

std::int64_t key_of(float height_m, float range_m) noexcept {
  const auto bits = std::bit_cast<std::int32_t>(height_m);
  const std::int32_t ordered = bits ^ ((bits >> 31) & 0x7FFF'FFFF);
  return std::int64_t{ordered} << 32 | std::int64_t{std::bit_cast<std::int32_t>(range_m)};
}

GroundSurface::LowestReturn return_of(std::int64_t key) noexcept {
  const auto ordered = static_cast<std::int32_t>(key >> 32);
  return {std::bit_cast<float>(ordered ^ ((ordered >> 31) & 0x7FFF'FFFF)),
          std::bit_cast<float>(static_cast<std::int32_t>(key))};
}

/// Keys of a row; cells without a return get that of an empty grid cell.
TERRACUT_VECTOR_CLONES void find_keys(const float* __restrict z_m, const float* __restrict range_m,
                                      const std::uint32_t* __restrict stamp,
                                      std::uint32_t generation,
                                      std::span<std::int64_t> keys) noexcept {
  const std::size_t count = keys.size();
  std::int64_t* const __restrict out = keys.data();
  for (std::size_t i = 0; i < count; ++i) {
    const bool has_return = stamp[i] == generation;
    out[i] = key_of(has_return ? z_m[i] : GroundSurface::kEmpty, has_return ? range_m[i] : 0.0F);
  }
}

}  // namespace

RingElevationMap::RingElevationMap(const Config& config, const calib::RingProfile& profile,
                                   ImageShape shape, rt::FixedMemory& memory)
    : config_(config),
      grid_(config.grid, profile, shape, memory),
      surface_(config.surface, grid_, memory),
      lowest_(memory.take<GroundSurface::LowestReturn>("ring grid", grid_.cells())),
      lowest_key_(memory.take<std::int64_t>("ring grid", grid_.cells())),
      row_keys_(memory.take<std::int64_t>("ring grid", static_cast<std::size_t>(shape.columns))),
      row_steps_(memory.take<std::uint16_t>("ring grid", row_keys_.size())) {}

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
  std::fill(lowest_key_.begin(), lowest_key_.end(), key_of(GroundSurface::kEmpty, 0.0F));
  const ImageShape& shape = image.shape();
  for (int row = 0; row < shape.rows; ++row) {
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(shape.stride());
    find_keys(&image.z_m()[first], &image.ground_range_m()[first], &image.stamp()[first],
              image.generation(), row_keys_);
    grid_.find_steps(image.ground_range_m().subspan(first, row_steps_.size()), row_steps_);
    for (int sector = 0; sector < grid_.sectors(); ++sector) {
      const auto [begin, end] = grid_.columns_of(sector);
      for (std::size_t column = begin; column < end; ++column) {
        std::int64_t& lowest =
            lowest_key_[grid_.cell(sector, grid_.band_of_step(row_steps_[column]))];
        lowest = std::min(lowest, row_keys_[column]);
      }
    }
  }
  for (const OverflowReturn& extra : image.overflow()) {
    const int column = static_cast<int>(extra.cell % static_cast<std::uint32_t>(shape.stride()));
    std::int64_t& lowest =
        lowest_key_[grid_.cell(grid_.sector_of(column), grid_.band_of(extra.echo.ground_range_m))];
    lowest = std::min(lowest, key_of(extra.echo.z_m, extra.echo.ground_range_m));
  }
  for (std::size_t i = 0; i < lowest_.size(); ++i) lowest_[i] = return_of(lowest_key_[i]);
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
