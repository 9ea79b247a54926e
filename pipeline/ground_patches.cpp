// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground_patches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "rt/vector_clones.hpp"

namespace terracut::pipeline {
namespace {

/// How far the height of each return departs from the middle of its neighbours' in its row, where
/// all three are ground. Without branches, so that the compiler makes vector code of it.
TERRACUT_VECTOR_CLONES void find_bends(const float* z_m, const Label* label, std::size_t columns,
                                       float* bend_m, std::uint8_t* is_bend) noexcept {
  for (std::size_t i = 1; i + 1 < columns; ++i) {
    is_bend[i] = (label[i - 1] == Label::kGround) & (label[i] == Label::kGround) &
                 (label[i + 1] == Label::kGround);
  }
  for (std::size_t i = 1; i + 1 < columns; ++i) {
    const float bend = std::fabs(z_m[i] - 0.5F * (z_m[i - 1] + z_m[i + 1]));
    bend_m[i] = is_bend[i] != 0 ? bend : 0.0F;
  }
}

}  // namespace

GroundPatches::GroundPatches(const Config& config, ImageShape shape, rt::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      columns_per_patch_(std::clamp(
          static_cast<int>(std::lround(static_cast<double>(config.width_deg) / shape.pitch_deg())),
          1, shape.columns)),
      per_row_((shape.columns + columns_per_patch_ - 1) / columns_per_patch_),
      spacing_rad_(static_cast<float>(columns_per_patch_ * 2 * std::numbers::pi / shape.columns)),
      patches_(memory.take<Patch>("ground patches", static_cast<std::size_t>(shape.rows) *
                                                        static_cast<std::size_t>(per_row_))),
      bend_m_(memory.take<float>("ground patches", static_cast<std::size_t>(shape.columns))),
      is_bend_(
          memory.take<std::uint8_t>("ground patches", static_cast<std::size_t>(shape.columns))),
      bends_before_(memory.take<Bends>(
          "ground patches", static_cast<std::size_t>(per_row_ + 2 * kMostPatchesOver + 1))) {}

int GroundPatches::patches_over(float length_m, float range_m) const noexcept {
  const float patches = length_m / std::max(spacing_m(range_m), 0.001F) + 0.5F;
  return patches < kMostPatchesOver ? std::max(1, static_cast<int>(patches)) : kMostPatchesOver;
}

void GroundPatches::collect(const RangeImage& image, const CellPlanes& planes) noexcept {
  for (int row = 0; row < shape_.rows; ++row) {
    collect_row(image, planes, row);
    smooth_roughness(row);
  }
}

void GroundPatches::collect_row(const RangeImage& image, const CellPlanes& planes,
                                int row) noexcept {
  const auto columns = static_cast<std::size_t>(shape_.columns);
  const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(shape_.stride());
  const float* const x_m = &image.x_m()[first];
  const float* const y_m = &image.y_m()[first];
  const float* const z_m = &image.z_m()[first];
  const float* const range_m = &image.ground_range_m()[first];
  const float* const height_m = &planes.height_m[first];
  const Label* const label = &planes.label[first];
  find_bends(z_m, label, columns, bend_m_.data(), is_bend_.data());

  Patch* const patches =
      &patches_[static_cast<std::size_t>(row) * static_cast<std::size_t>(per_row_)];
  std::size_t end = 0;
  for (int i = 0; i < per_row_; ++i) {
    const std::size_t begin = end;
    end = std::min(begin + static_cast<std::size_t>(columns_per_patch_), columns);
    std::size_t ground = 0;
    for (std::size_t c = begin; c < end; ++c) ground += label[c] == Label::kGround;
    float sum_x_m = 0, sum_y_m = 0, sum_z_m = 0, sum_range_m = 0;
    bool has_obstacle = false;
    float nearest_m = std::numeric_limits<float>::max();
    if (ground == end - begin) {  // the usual case, and one without branches
      for (std::size_t c = begin; c < end; ++c) {
        sum_x_m += x_m[c];
        sum_y_m += y_m[c];
        sum_z_m += z_m[c];
        sum_range_m += range_m[c];
      }
    } else {
      for (std::size_t c = begin; c < end; ++c) {
        const bool is_ground = label[c] == Label::kGround;
        sum_x_m += is_ground ? x_m[c] : 0.0F;
        sum_y_m += is_ground ? y_m[c] : 0.0F;
        sum_z_m += is_ground ? z_m[c] : 0.0F;
        sum_range_m += is_ground ? range_m[c] : 0.0F;
        // The height of a cell without a return is NaN: not lower than anything.
        const bool bars = !is_ground & (height_m[c] < config_.clearance_height_m);
        nearest_m = bars ? std::min(nearest_m, range_m[c]) : nearest_m;
        has_obstacle |= bars;
      }
    }
    const float share = ground > 0 ? 1.0F / static_cast<float>(ground) : 0.0F;
    Patch& patch = patches[i];
    patch.x_m = sum_x_m * share;
    patch.y_m = sum_y_m * share;
    patch.z_m = sum_z_m * share;
    patch.range_m = ground > 0 ? sum_range_m * share : has_obstacle ? nearest_m : 0.0F;
    patch.roughness_m = 0;
    patch.has_ground = ground > 0;
    patch.has_obstacle = has_obstacle;
  }
}

void GroundPatches::sum_bends() noexcept {
  // From some patches before the first one to some after the last one, around the circle.
  const auto columns = static_cast<std::size_t>(shape_.columns);
  const auto width = static_cast<std::size_t>(columns_per_patch_);
  Bends sums;
  for (int i = 0; i < per_row_ + 2 * kMostPatchesOver; ++i) {
    bends_before_[static_cast<std::size_t>(i)] = sums;
    const auto begin = static_cast<std::size_t>(wrapped(i - kMostPatchesOver)) * width;
    const std::size_t end = std::min(begin + width, columns);
    float sum_m = 0;
    int count = 0;
    for (std::size_t c = begin; c < end; ++c) sum_m += bend_m_[c];
    for (std::size_t c = begin; c < end; ++c) count += is_bend_[c];
    sums.sum_m += sum_m;
    sums.count += static_cast<float>(count);
  }
  bends_before_.back() = sums;
}

void GroundPatches::smooth_roughness(int row) noexcept {
  Patch* const patches =
      &patches_[static_cast<std::size_t>(row) * static_cast<std::size_t>(per_row_)];
  sum_bends();
  for (int i = 0; i < per_row_; ++i) {
    if (!patches[i].has_ground) continue;
    const int reach = patches_over(config_.roughness_window_m, patches[i].range_m);
    const Bends& first = bends_before_[static_cast<std::size_t>(i + kMostPatchesOver - reach)];
    const Bends& last = bends_before_[static_cast<std::size_t>(i + kMostPatchesOver + reach + 1)];
    const float count = last.count - first.count;
    patches[i].roughness_m = count > 0 ? (last.sum_m - first.sum_m) / count : 0;
  }
}

}  // namespace terracut::pipeline
