// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/road/ground_patches.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "rt/vector_clones.hpp"

namespace terracut::road {
namespace {

constexpr float kFar_m = std::numeric_limits<float>::max();
constexpr float kUnknown_m = std::numeric_limits<float>::quiet_NaN();
constexpr float kLeastSpacing_m = 0.001F;  // Limits the spacing close to the sensor.
constexpr auto kMostOver = static_cast<float>(GroundPatches::kMostPatchesOver);

// The loops of the next functions have no branches, so that the compiler vectorises them.

/// Finds for each return of a row whether it is ground, whether its neighbours are, too (is_bend),
/// and how far its height is from the mean of its neighbours' (valid only if is_bend).
TERRACUT_VECTOR_CLONES void find_bends(const float* z_m, const frame::Label* label,
                                       std::size_t columns, std::uint8_t* __restrict is_ground,
                                       std::uint8_t* __restrict is_bend,
                                       float* __restrict bend_m) noexcept {
  for (std::size_t i = 0; i < columns; ++i) is_ground[i] = label[i] == frame::Label::kGround;
  for (std::size_t i = 1; i + 1 < columns; ++i) {
    is_bend[i] = is_ground[i - 1] & is_ground[i] & is_ground[i + 1];
  }
  for (std::size_t i = 1; i + 1 < columns; ++i) {
    bend_m[i] = std::fabs(z_m[i] - 0.5F * (z_m[i - 1] + z_m[i + 1]));
  }
  for (const std::size_t i : {std::size_t{0}, columns - 1}) {  // the image is cyclic
    const std::size_t before = i > 0 ? i - 1 : columns - 1, after = i + 1 < columns ? i + 1 : 0;
    is_bend[i] = is_ground[before] & is_ground[i] & is_ground[after];
    bend_m[i] = std::fabs(z_m[i] - 0.5F * (z_m[before] + z_m[after]));
  }
}

/// Returns the ranges of cells lower than `clearance_height_m`, and kFar_m for all others. A cell
/// without a return has a NaN height, which is not lower.
TERRACUT_VECTOR_CLONES void find_low(const float* range_m, const float* height_m,
                                     std::size_t columns, float clearance_height_m,
                                     float* __restrict low_m) noexcept {
  for (std::size_t i = 0; i < columns; ++i) {
    const float range = range_m[i];
    low_m[i] = height_m[i] < clearance_height_m ? range : kFar_m;
  }
}

/// Computes patches_over() for many ranges.
TERRACUT_VECTOR_CLONES void count_over(float length_m, const float* range_m, std::size_t count,
                                       float spacing_rad, std::int32_t* patches) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const float spacing_m = range_m[i] * spacing_rad;
    const float over =
        length_m / (spacing_m > kLeastSpacing_m ? spacing_m : kLeastSpacing_m) + 0.5F;
    const auto whole = static_cast<std::int32_t>(over < kMostOver ? over : kMostOver);
    patches[i] = whole > 1 ? whole : 1;
  }
}

constexpr std::size_t kReadAhead = 8;

/// The columns of a patch. `kWidth` is their number if known at compile time, else 0.
template <std::size_t kWidth>
struct ColumnsOf {
  explicit ColumnsOf(std::size_t how_many) : count(how_many) {}

  [[nodiscard]] std::size_t size() const noexcept { return kWidth > 0 ? kWidth : count; }
  [[nodiscard]] float sum(const float* values) const noexcept {
    float all = 0;
    for (std::size_t i = 0; i < size(); ++i) all += values[i];
    return all;
  }
  [[nodiscard]] float least(const float* values) const noexcept {
    float least = values[0];
    for (std::size_t i = 1; i < size(); ++i) least = std::min(least, values[i]);
    return least;
  }
  /// Returns how many values are 1; the others must be 0. Reads kReadAhead values beyond the first.
  [[nodiscard]] std::size_t count_of(const std::uint8_t* values) const noexcept {
    if constexpr (kWidth > 0 && kWidth <= 8) {  // all at once: the product's top byte is the sum
      std::uint64_t bytes = 0;
      std::memcpy(&bytes, values, sizeof bytes);
      constexpr auto kOthers = 8 * (sizeof bytes - kWidth);
      bytes = std::endian::native == std::endian::little ? bytes << kOthers : bytes >> kOthers;
      return bytes * 0x0101010101010101U >> 56;
    }
    std::size_t all = 0;
    for (std::size_t i = 0; i < size(); ++i) all += values[i];
    return all;
  }

  std::size_t count;
};

/// The column planes of a row, each from its first column on.
struct RowOfColumns {
  const float *x_m, *y_m, *z_m, *range_m;
  const std::uint8_t *is_ground, *is_bend;
  const float *bend_m, *low_m;
  const float* height_m;
  const std::uint32_t* return_index;
  std::size_t stride;

  /// Prefetches some columns of the next row: its six planes are not in the cache, which earlier
  /// stages have filled.
  void fetch_ahead(std::size_t column) const noexcept {
    for (const float* plane : {x_m, y_m, z_m, range_m, height_m}) {
      __builtin_prefetch(plane + column + stride);
    }
  }
};

/// The patch planes of a row, each from its first patch on.
struct RowOfPatches {
  float *x_m, *y_m, *z_m, *range_m;
  std::uint8_t *has_ground, *has_obstacle;
  GroundPatches::Bends* bends;
  std::uint32_t* arrival;
};

/// Returns the sum of the values marked by 1; those marked by 0 may be NaN.
template <class Columns>
float sum_of_marked(const float* values, const std::uint8_t* marks, std::size_t marked,
                    Columns width) noexcept {
  if (marked == width.size()) return width.sum(values);
  float all = 0;
  for (std::size_t i = 0; i < width.size(); ++i) all += marks[i] != 0 ? values[i] : 0.0F;
  return all;
}

template <class Columns>
void collect_patch(const RowOfColumns& row, std::size_t begin, Columns width,
                   const RowOfPatches& patches, std::size_t patch) noexcept {
  const std::uint8_t* const is_ground = row.is_ground + begin;
  const std::size_t ground = width.count_of(is_ground);
  patches.has_ground[patch] = ground > 0;
  if (ground == 0) {
    const float nearest_m = width.least(row.low_m + begin);
    patches.has_obstacle[patch] = nearest_m < kFar_m;
    patches.x_m[patch] = patches.y_m[patch] = patches.z_m[patch] = 0;
    patches.range_m[patch] = nearest_m < kFar_m ? nearest_m : kUnknown_m;
    patches.bends[patch] = {};
    return;
  }
  std::size_t left = 0, right = width.size() - 1;
  bool has_obstacle = false;
  if (ground < width.size()) {
    while (is_ground[left] == 0) ++left;
    while (is_ground[right] == 0) --right;
    for (std::size_t i = 0; i < width.size(); ++i) {
      has_obstacle |= (is_ground[i] == 0) & (row.low_m[begin + i] < kFar_m);
    }
  }
  left += begin;
  right += begin;
  patches.arrival[patch] = row.return_index[left];
  const std::size_t bends = width.count_of(row.is_bend + begin);
  patches.has_obstacle[patch] = has_obstacle;
  patches.x_m[patch] = 0.5F * (row.x_m[left] + row.x_m[right]);
  patches.y_m[patch] = 0.5F * (row.y_m[left] + row.y_m[right]);
  patches.range_m[patch] = 0.5F * (row.range_m[left] + row.range_m[right]);
  const float share = 1.0F / static_cast<float>(ground);
  patches.z_m[patch] = sum_of_marked(row.z_m + begin, is_ground, ground, width) * share;
  patches.bends[patch] = {sum_of_marked(row.bend_m + begin, row.is_bend + begin, bends, width),
                          static_cast<float>(bends)};
}

template <class Columns>
void collect_row(const RowOfColumns row, std::size_t columns, Columns width,
                 const RowOfPatches patches) noexcept {
  const std::size_t whole = columns / width.size(), rest = columns % width.size();
  for (std::size_t i = 0; i < whole; ++i) {
    const std::size_t begin = i * width.size();
    row.fetch_ahead(begin);
    collect_patch(row, begin, width, patches, i);
  }
  if (rest > 0) collect_patch(row, whole * width.size(), ColumnsOf<0>(rest), patches, whole);
}

}  // namespace

GroundPatches::GroundPatches(const Config& config, frame::ImageShape shape,
                             memory::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      columns_per_patch_(std::clamp(
          static_cast<int>(std::lround(static_cast<double>(config.width_deg) / shape.pitch_deg())),
          1, shape.columns)),
      per_row_((shape.columns + columns_per_patch_ - 1) / columns_per_patch_),
      spacing_rad_(static_cast<float>(columns_per_patch_ * 2 * std::numbers::pi / shape.columns)) {
  const auto per_row = static_cast<std::size_t>(per_row_);
  const auto columns = static_cast<std::size_t>(shape.columns);
  const std::size_t patches = static_cast<std::size_t>(shape.rows) * per_row;
  for (std::span<float>* values : {&x_m_, &y_m_, &z_m_, &range_m_, &roughness_m_}) {
    *values = memory.take<float>("ground patches", patches);
  }
  has_ground_ = memory.take<std::uint8_t>("ground patches", patches);
  is_seam_ = memory.take<std::uint8_t>("ground patches", patches);
  arrival_ = memory.take<std::uint32_t>("ground patches", per_row);
  has_obstacle_ = memory.take<std::uint8_t>("ground patches", patches);
  bend_m_ = memory.take<float>("ground patches", columns);
  low_m_ = memory.take<float>("ground patches", columns);
  is_ground_ = memory.take<std::uint8_t>("ground patches", columns + kReadAhead);
  is_bend_ = memory.take<std::uint8_t>("ground patches", columns + kReadAhead);
  bends_ = memory.take<Bends>("ground patches", per_row + 2 * kMostPatchesOver);
  bends_before_ = memory.take<Bends>("ground patches", per_row + 2 * kMostPatchesOver + 1);
  reach_ = memory.take<std::int32_t>("ground patches", per_row);
}

int GroundPatches::patches_over(float length_m, float range_m) const noexcept {
  const float patches = length_m / std::max(spacing_m(range_m), kLeastSpacing_m) + 0.5F;
  return std::max(1, static_cast<int>(std::min(patches, kMostOver)));
}

void GroundPatches::count_patches_over(float length_m, std::size_t row,
                                       std::span<std::int32_t> patches) const noexcept {
  const auto per_row = static_cast<std::size_t>(per_row_);
  count_over(length_m, &range_m_[row * per_row], per_row, spacing_rad_, patches.data());
}

void GroundPatches::collect(const frame::RangeImage& image,
                            const stage::CellPlanes& planes) noexcept {
  const auto columns = static_cast<std::size_t>(shape_.columns);
  const auto per_row = static_cast<std::size_t>(per_row_);
  const auto width = static_cast<std::size_t>(columns_per_patch_);
  for (std::size_t number = 0; number < static_cast<std::size_t>(shape_.rows); ++number) {
    const std::size_t first = number * static_cast<std::size_t>(shape_.stride());
    const std::size_t first_patch = number * per_row;
    const RowOfColumns row{&image.x_m()[first],
                           &image.y_m()[first],
                           &image.z_m()[first],
                           &image.ground_range_m()[first],
                           is_ground_.data(),
                           is_bend_.data(),
                           bend_m_.data(),
                           low_m_.data(),
                           &planes.height_m[first],
                           &image.return_index()[first],
                           static_cast<std::size_t>(shape_.stride())};
    const RowOfPatches patches{&x_m_[first_patch],        &y_m_[first_patch],
                               &z_m_[first_patch],        &range_m_[first_patch],
                               &has_ground_[first_patch], &has_obstacle_[first_patch],
                               &bends_[kMostPatchesOver], arrival_.data()};
    find_bends(row.z_m, &planes.label[first], columns, is_ground_.data(), is_bend_.data(),
               bend_m_.data());
    find_low(row.range_m, &planes.height_m[first], columns, config_.clearance_height_m,
             low_m_.data());
    switch (width) {
      case 5:
        collect_row(row, columns, ColumnsOf<5>(5), patches);
        break;  // the width for an RS-Ruby128 with 0.2 deg steps
      case 6:
        collect_row(row, columns, ColumnsOf<6>(6), patches);
        break;  // the width for an HDL-64E at 10 Hz
      default:
        collect_row(row, columns, ColumnsOf<0>(width), patches);
        break;
    }
    find_seam(number, image.returns());
    smooth_roughness(number);
  }
}

void GroundPatches::find_seam(std::size_t row, std::uint32_t returns) noexcept {
  const auto per_row = static_cast<std::size_t>(per_row_);
  const std::uint8_t* const has_ground = &has_ground_[row * per_row];
  std::uint8_t* const is_seam = &is_seam_[row * per_row];
  const auto is_apart = [&](std::size_t one, std::size_t other) {
    const std::uint32_t least = std::min(arrival_[one], arrival_[other]);
    const std::uint32_t most = std::max(arrival_[one], arrival_[other]);
    return (most - least > returns / 2) & (has_ground[one] != 0) & (has_ground[other] != 0);
  };
  for (std::size_t i = 0; i < per_row; ++i) {
    const std::size_t next = i + 1 < per_row ? i + 1 : 0;
    is_seam[i] = is_apart(i, next) ? 1 : 0;
    if (is_seam[i] != 0) bends_[kMostPatchesOver + i] = bends_[kMostPatchesOver + next] = {};
  }
}

void GroundPatches::smooth_roughness(std::size_t row) noexcept {
  const auto per_row = static_cast<std::size_t>(per_row_);
  for (std::size_t i = 0; i < kMostPatchesOver; ++i) {
    const auto margin = static_cast<int>(i);
    bends_[i] =
        bends_[kMostPatchesOver + static_cast<std::size_t>(wrapped(margin - kMostPatchesOver))];
    bends_[kMostPatchesOver + per_row + i] =
        bends_[kMostPatchesOver + static_cast<std::size_t>(wrapped(margin))];
  }
  Bends sums;
  for (std::size_t i = 0; i < bends_.size(); ++i) {
    bends_before_[i] = sums;
    sums.sum_m += bends_[i].sum_m;
    sums.count += bends_[i].count;
  }
  bends_before_.back() = sums;
  count_patches_over(config_.roughness_window_m, row, reach_);
  for (std::size_t i = 0; i < per_row; ++i) {
    const auto reach = static_cast<std::size_t>(reach_[i]);
    const Bends& first = bends_before_[i + kMostPatchesOver - reach];
    const Bends& last = bends_before_[i + kMostPatchesOver + reach + 1];
    const float count = last.count - first.count;
    const float mean_m = (last.sum_m - first.sum_m) / std::max(count, 1.0F);
    const bool is_known = (count > 0) & (has_ground_[row * per_row + i] != 0);
    roughness_m_[row * per_row + i] = is_known ? mean_m : 0;
  }
}

}  // namespace terracut::road
