// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/adjacent_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <span>

#include "pipeline/stage/row_steps.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::elevation {
namespace {

/// Returns the bound of Eq. 5: the least horizontal distance of two beams' ground points on ground
/// no steeper than K. delta is a beam's angle from the downward normal, h the height where beams
/// start.
double least_distance_m(double height_m, double lower_elevation_rad, double upper_elevation_rad,
                        double max_slope_rad) {
  const double tan_delta1 = std::tan(std::numbers::pi / 2 + lower_elevation_rad);
  const double tan_delta2 = std::tan(std::numbers::pi / 2 + upper_elevation_rad);
  return height_m * (tan_delta2 - tan_delta1) / (std::tan(max_slope_rad) * tan_delta2 + 1);
}

/// The planes of a row, each from its first column on.
struct Row {
  const float *x_m, *y_m, *z_m, *height_m;
  std::uint8_t* steep;

  [[nodiscard]] Row from(int column) const noexcept {
    return {x_m + column, y_m + column, z_m + column, height_m + column, steep + column};
  }
};
struct RowPair {
  Row lower, upper;
};

// The loops below have no branches, so that the compiler vectorises them; comparisons with the NaN
// heights of empty cells are false.

/// Columns processed at once, each one byte of a vector.
constexpr int kTogether = 32;

/// Shifts the rows against each other: index i is then the pair whose right return is in column i.
/// With a positive offset of the upper column from the lower one, the upper return is the right
/// one.
[[gnu::always_inline]] inline RowPair shifted(const RowPair& rows, int offset) noexcept {
  return {rows.lower.from(-std::max(offset, 0)), rows.upper.from(std::min(offset, 0))};
}

/// Calls `mark` for the rows shifted by each offset; the right returns are in `columns`, and no
/// left one lies across the seam.
template <class Mark>
[[gnu::always_inline]] inline void for_each_offset(const RowPair& rows, frame::ColumnRange columns,
                                                   int reach, Mark mark) noexcept {
  for (int offset = -reach; offset <= reach; ++offset) {
    const int begin = std::max(columns.begin, std::abs(offset));
    if (begin >= columns.end) continue;
    const RowPair pair = shifted(rows, offset);
    mark(RowPair{pair.lower.from(begin), pair.upper.from(begin)}, columns.end - begin);
  }
}

// Further flags in a byte of CellPlanes::steep while rows are compared.
constexpr std::uint8_t kHasReturn = 2;
constexpr std::uint8_t kIsRaised = 4;   ///< High enough to be the upper return of a step.
constexpr std::uint8_t kUpperMay = 8;   ///< Marking it as the upper return matters.
constexpr std::uint8_t kLowerMay = 16;  ///< Marking it as the lower return matters.

/// AdjacentRule::kSlope
struct SlopeRule {
  float min_rise_m, tan_max_slope_squared;

  /// Marks the upper return of pairs with too steep a step, and the lower one if it is high enough;
  /// each only if it matters. `count` is at most kTogether.
  [[gnu::always_inline]] void mark(const RowPair& rows, int count) const noexcept {
    std::uint8_t is_steep[kTogether];
    for (int i = 0; i < count; ++i) {
      const float dx = rows.upper.x_m[i] - rows.lower.x_m[i];
      const float dy = rows.upper.y_m[i] - rows.lower.y_m[i];
      const float rise = rows.upper.z_m[i] - rows.lower.z_m[i];
      is_steep[i] =
          (rise >= min_rise_m) & ((dx * dx + dy * dy) * tan_max_slope_squared < rise * rise);
    }
    // Only bit 0 of each byte is used.
    for (int i = 0; i < count; ++i) {
      const std::uint8_t up = rows.upper.steep[i], low = rows.lower.steep[i];
      rows.upper.steep[i] = static_cast<std::uint8_t>(up | (is_steep[i] & (up >> 3) & (low >> 1)));
      is_steep[i] = static_cast<std::uint8_t>(is_steep[i] & (low >> 4) & (up >> 2));
    }
    for (int i = 0; i < count; ++i) {
      rows.lower.steep[i] = static_cast<std::uint8_t>(rows.lower.steep[i] | is_steep[i]);
    }
  }
};

/// Returns the union of the flags of kTogether returns and of those up to `reach` to the left.
[[gnu::always_inline]] inline std::uint8_t flags_around(const std::uint8_t* steep,
                                                        int reach) noexcept {
  std::uint64_t any = 0;
  for (int i = 0; i < kTogether; i += int{sizeof(any)}) {
    std::uint64_t here, left;
    std::memcpy(&here, steep + i, sizeof(here));
    std::memcpy(&left, steep + i - reach, sizeof(left));
    any |= here | left;
  }
  any |= any >> 32U;
  any |= any >> 16U;
  return static_cast<std::uint8_t>(any | any >> 8U);
}

/// False only if none of kTogether pairs can change `steep`, at any offset. Most pairs cannot: they
/// are both on the ground or both far above it.
[[gnu::always_inline]] inline bool may_matter(const RowPair& rows, int reach) noexcept {
  const std::uint8_t upper = flags_around(rows.upper.steep, reach);
  return (upper & kUpperMay) != 0 ||
         ((upper & kIsRaised) != 0 && (flags_around(rows.lower.steep, reach) & kLowerMay) != 0);
}

/// Sets the flags of a row's returns from their heights.
TERRACUT_VECTOR_CLONES void find_what_matters(std::span<const float> height_m, float min_upper_m,
                                              float min_lower_m, float max_m,
                                              std::uint8_t* __restrict steep) noexcept {
  constexpr int kAll = kHasReturn | kIsRaised | kUpperMay | kLowerMay;
  // Computes in integers as wide as heights: otherwise each comparison is narrowed by itself.
  std::int32_t flags[kTogether];
  for (std::size_t first = 0; first < height_m.size(); first += kTogether) {
    const std::size_t count = std::min(height_m.size() - first, std::size_t{kTogether});
    for (std::size_t i = 0; i < count; ++i) {
      const float h = height_m[first + i];
      flags[i] = (h <= max_m ? kAll : kHasReturn | kIsRaised) &
                 ((h == h ? kHasReturn : 0) | (h >= min_upper_m ? kIsRaised | kUpperMay : 0) |
                  (h >= min_lower_m ? kLowerMay : 0));
    }
    for (std::size_t i = 0; i < count; ++i) {
      steep[first + i] = static_cast<std::uint8_t>(flags[i]);
    }
  }
}

/// AdjacentRule::kRingSpacing
struct SpacingRule {
  float bound_m;

  /// Marks the upper return of pairs closer than the bound.
  [[gnu::always_inline]] void mark(const RowPair& rows, int count) const noexcept {
    const Row lower = rows.lower, upper = rows.upper;
    const float bound_squared = bound_m * bound_m;
    for (int i = 0; i < count; ++i) {
      const float dx = upper.x_m[i] - lower.x_m[i];
      const float dy = upper.y_m[i] - lower.y_m[i];
      const bool is_steep = (dx * dx + dy * dy < bound_squared) &
                            (upper.height_m[i] == upper.height_m[i]) &
                            (lower.height_m[i] == lower.height_m[i]);
      upper.steep[i] = static_cast<std::uint8_t>(upper.steep[i] | std::uint8_t{is_steep});
    }
  }
};

/// Compares 32 columns at a time; the last block overlaps the one before, harmlessly. Columns whose
/// left returns may lie across the seam, or that are fewer, are compared first.
TERRACUT_VECTOR_CLONES void mark_by_slope(const RowPair rows, const frame::ColumnRange columns,
                                          int reach, const SlopeRule rule) noexcept {
  const int last = columns.end - kTogether;
  const int together = last < reach ? columns.end : std::max(columns.begin, reach);
  for (int column = columns.begin; column < together; column += kTogether) {
    for_each_offset(rows, {column, std::min(column + kTogether, together)}, reach,
                    [&](const RowPair& some, int count) { rule.mark(some, count); });
  }
  for (int column = together; column < columns.end; column += kTogether) {
    const int begin = std::min(column, last);
    const RowPair some{rows.lower.from(begin), rows.upper.from(begin)};
    if (!may_matter(some, reach)) continue;
    for (int offset = -reach; offset <= reach; ++offset) {
      rule.mark(shifted(some, offset), kTogether);
    }
  }
}

TERRACUT_VECTOR_CLONES void mark_by_spacing(const RowPair rows, const frame::ColumnRange columns,
                                            int reach, const SpacingRule rule) noexcept {
  for_each_offset(rows, columns, reach,
                  [&](const RowPair& shifted, int count) { rule.mark(shifted, count); });
}

TERRACUT_VECTOR_CLONES void make_obstacles(std::span<const std::uint8_t> steep,
                                           frame::Label* label) noexcept {
  for (std::size_t cell = 0; cell < steep.size(); ++cell) {
    const bool is_steep = (steep[cell] & stage::kSteep) != 0;
    label[cell] = is_steep ? frame::Label::kObstacle : label[cell];
  }
}

}  // namespace

AdjacentPoints::AdjacentPoints(const Config& config, float max_height_m,
                               const mount::RingProfile& profile, frame::ImageShape shape,
                               memory::FixedMemory& memory)
    : config_(config),
      max_height_m_(max_height_m),
      shape_(shape),
      tan_max_slope_squared_(
          static_cast<float>(std::pow(std::tan(static_cast<double>(config.max_slope_rad)), 2))),
      ring_spacing_m_(memory.take<float>(
          "adjacent points", static_cast<std::size_t>(config.last_row_step * shape.rows))),
      upper_row_(memory.take<std::int32_t>("adjacent points", ring_spacing_m_.size())) {
  const stage::RowSteps row_steps(profile, static_cast<double>(config.row_step_deg));
  for (int step = 1; step <= config.last_row_step; ++step) {
    for (int row = 0; row < shape.rows; ++row) {
      const auto pair = static_cast<std::size_t>((step - 1) * shape.rows + row);
      upper_row_[pair] = row_steps.up(row, step);
      if (upper_row_[pair] == shape.rows) continue;
      const mount::Ring& lower = profile.rings[static_cast<std::size_t>(row)];
      const mount::Ring& upper = profile.rings[static_cast<std::size_t>(upper_row_[pair])];
      if (!std::isfinite(upper.ground_distance_m)) continue;
      const double bound_m =
          least_distance_m(profile.mount.height_m + upper.origin_height_m, lower.elevation_rad,
                           upper.elevation_rad, static_cast<double>(config.max_slope_rad));
      ring_spacing_m_[pair] = static_cast<float>(std::fmax(bound_m, 0.0));
    }
  }
}

float AdjacentPoints::ring_spacing_m(int row, int row_step) const noexcept {
  return ring_spacing_m_[static_cast<std::size_t>((row_step - 1) * shape_.rows + row)];
}

void AdjacentPoints::reset(frame::ColumnRange columns, stage::CellPlanes& planes) const noexcept {
  for (int row = 0; row < shape_.rows; ++row) {
    const std::size_t first = shape_.cell(row, columns.begin);
    find_what_matters(planes.height_m.subspan(first, columns.size()), config_.min_upper_height_m,
                      config_.min_lower_height_m, max_height_m_, &planes.steep[first]);
  }
}

void AdjacentPoints::mark(frame::ColumnRange columns, stage::CellPlanes& planes) const noexcept {
  for (int row = 0; row < shape_.rows; ++row) {
    const std::size_t first = shape_.cell(row, columns.begin);
    make_obstacles(planes.steep.subspan(first, columns.size()), &planes.label[first]);
  }
}

template <class Visit>
void AdjacentPoints::for_each_row_pair(const frame::PointPlanes& points, stage::CellPlanes& planes,
                                       Visit visit) const noexcept {
  const auto row_of = [&](int row) noexcept {
    const std::size_t first = shape_.cell(row, 0);
    return Row{&points.x_m[first], &points.y_m[first], &points.z_m[first], &planes.height_m[first],
               &planes.steep[first]};
  };
  for (int row = 0; row < shape_.rows; ++row) {
    for (int step = config_.first_row_step; step <= config_.last_row_step; ++step) {
      const int upper_row = upper_row_[static_cast<std::size_t>((step - 1) * shape_.rows + row)];
      if (upper_row == shape_.rows) break;  // there are no more rows above
      visit(RowPair{row_of(row), row_of(upper_row)}, ring_spacing_m(row, step));
    }
  }
}

void AdjacentPoints::compare(const frame::PointPlanes& points, frame::ColumnRange columns,
                             stage::CellPlanes& planes) noexcept {
  if (config_.rule == AdjacentRule::kSlope) {
    const SlopeRule rule{config_.min_rise_m, tan_max_slope_squared_};
    for_each_row_pair(points, planes, [&](const RowPair& rows, float) noexcept {
      mark_by_slope(rows, columns, reach(), rule);
    });
  } else {
    for_each_row_pair(points, planes, [&](const RowPair& rows, float bound_m) noexcept {
      mark_by_spacing(rows, columns, reach(), SpacingRule{bound_m});
    });
  }
}

void AdjacentPoints::compare_across_seam(const frame::PointPlanes& points,
                                         stage::CellPlanes& planes) noexcept {
  const auto mark = [&](const RowPair& rows, auto rule) noexcept {
    for (int offset = 1; offset <= reach(); ++offset) {
      for (int right = 0; right < offset; ++right) {
        const int left = right - offset + shape_.columns;
        rule.mark({rows.lower.from(left), rows.upper.from(right)}, 1);
        rule.mark({rows.lower.from(right), rows.upper.from(left)}, 1);
      }
    }
  };
  const SlopeRule slope{config_.min_rise_m, tan_max_slope_squared_};
  for_each_row_pair(points, planes, [&](const RowPair& rows, float bound_m) noexcept {
    if (config_.rule == AdjacentRule::kSlope) {
      mark(rows, slope);
    } else {
      mark(rows, SpacingRule{bound_m});
    }
  });
}

}  // namespace terracut::elevation
