// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "detection_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/stage/row_steps.hpp"

namespace terracut::detection {
namespace {

constexpr double kNever_m = std::numeric_limits<double>::infinity();
constexpr double kRounding_m = 1e-3;   // of the floats in which the method computes
constexpr double kRangeStep_m = 0.02;  // up to kNear_m; grows with range beyond
constexpr double kNear_m = 20;
constexpr double kHeightStep_m =
    0.01;  // the ground at a front rises so much by a step of the slope
constexpr int kFewestColumns = 2;

}  // namespace

DetectionBound::DetectionBound(const ground::SegmenterConfig& config,
                               const mount::RingProfile& profile, frame::ImageShape shape,
                               const Assumptions& assumptions)
    : config_(config),
      assumptions_(assumptions),
      grid_(config.elevation_map.grid, profile, shape, memory_),
      opening_(config.elevation_map.opening, config.elevation_map.surface.far_slope, grid_, profile,
               memory_),
      column_rad_(2 * std::numbers::pi / shape.columns),
      sector_rad_(2 * std::numbers::pi / grid_.sectors()),
      fewest_columns_(shape.columns / grid_.sectors()) {
  for (const mount::Ring& ring : profile.rings) {
    const double rise = std::tan(ring.elevation_rad);
    const double start_m = profile.mount.height_m + ring.origin_height_m;
    // The ground distance tells how far before the axis a beam starts.
    const bool meets_ground = std::isfinite(ring.ground_distance_m);
    beams_.push_back({meets_ground ? -rise * ring.ground_distance_m : start_m, rise, {}});
  }
  const elevation::AdjacentPoints::Config& adjacent = config.adjacent_points;
  const stage::RowSteps steps(profile, double{adjacent.row_step_deg});
  for (std::size_t row = 0; row < beams_.size(); ++row) {
    for (int step = adjacent.first_row_step; step <= adjacent.last_row_step; ++step) {
      const auto upper = static_cast<std::size_t>(steps.up(static_cast<int>(row), step));
      if (upper < beams_.size()) beams_[upper].rows_below.push_back(row);
    }
  }
}

void DetectionBound::find_rows(Front& front) const {
  front.rows.clear();
  for (const Beam& beam : beams_) {
    const double rise = beam.rise - front.slope;
    const double height_m = beam.start_m + rise * front.range_m;
    const double either_m =
        (front.half_m + assumptions_.noise_m) * std::abs(rise) + front.half_slope * front.range_m;
    front.rows.push_back({height_m - either_m, height_m + either_m});
  }
}

Ranges DetectionBound::ground_ranges(std::size_t row, const Front& front) const {
  const Beam& beam = beams_[row];
  const auto range_m = [&](double slope, double height_m) {
    const double fall = slope - beam.rise;
    return fall > 0 ? (beam.start_m - height_m) / fall : kNever_m;
  };
  return {range_m(front.slope + front.half_slope, assumptions_.roughness_m),
          range_m(front.least_slope(), -assumptions_.roughness_m)};
}

double DetectionBound::across_slope(const Front& front) const {
  const double along = std::max(std::abs(front.slope) - front.half_slope, 0.0);
  return std::sqrt(std::max(assumptions_.slope * assumptions_.slope - along * along, 0.0));
}

double DetectionBound::most_step_up_m(double run_m, double unseen_m) const {
  const elevation::GroundSurface::Config& surface = config_.elevation_map.surface;
  return std::min(
      double{surface.step_up_m} + double{surface.slope_tolerance} * run_m,
      double{surface.step_up_limit_m} + double{surface.far_slope} * std::min(run_m, unseen_m));
}

double DetectionBound::most_passable_m(double run_m) const {
  const elevation::GroundSurface::Config& surface = config_.elevation_map.surface;
  const double deep_m = grid_.deepest_band_m();
  return double{surface.max_slope} * std::min(run_m, deep_m) +
         double{surface.far_slope} * std::max(run_m - deep_m, 0.0);
}

bool DetectionBound::is_traced(const Front& front, double before_m) const {
  const elevation::GroundSurface::Config& surface = config_.elevation_map.surface;
  const double steepest = std::abs(front.slope) + front.half_slope;
  const double uneven_m = 2 * assumptions_.roughness_m;
  if (steepest >= double{surface.start_slope} || uneven_m >= double{surface.step_up_m}) {
    return false;
  }
  double last_m = 0;
  for (std::size_t row = 0; row < beams_.size(); ++row) {
    const double at_m = ground_ranges(row, front).from_m;
    if (at_m <= last_m || at_m > before_m) continue;
    const double run_m = at_m - last_m;
    const double seen_apart_m = last_m > 0 ? unseen_m(band_of(at_m)) : 0.0;
    if (steepest * run_m + uneven_m >= most_step_up_m(run_m, seen_apart_m)) return false;
    last_m = at_m;
  }
  return true;
}

std::optional<DetectionBound::Ground> DetectionBound::ground_at(const Front& front) const {
  const double rough_m = assumptions_.roughness_m;
  const double near_m = front.range_m - front.half_m - assumptions_.noise_m;
  const double far_m = front.range_m + front.half_m + assumptions_.noise_m;
  const int band = band_of(near_m), last_band = band_of(far_m);
  Ground ground{.lowest_row = beams_.size()};
  double before_m = 0;  // range of the last ground return before the front
  bool has_ground_in_band = false;
  for (std::size_t row = 0; row < beams_.size(); ++row) {
    if (front.rows[row].low_m > rough_m) {
      ground.lowest_row = std::min(ground.lowest_row, row);
    } else if (front.rows[row].high_m < -rough_m) {
      const Ranges at = ground_ranges(row, front);
      before_m = std::max(before_m, at.from_m);
      has_ground_in_band |=
          band == last_band && band_of(at.from_m) == band && band_of(at.to_m) == band;
    }
  }
  if (ground.lowest_row == beams_.size() || !is_traced(front, before_m)) return std::nullopt;

  // Heights of the surface lie between returns on the plane, or are carried on level where none
  // follows, or interpolated from sectors to one side; they may be tilted across a sector.
  const elevation::GroundSurface::Config& surface = config_.elevation_map.surface;
  const int outer = std::min(grid_.mix_of(static_cast<float>(far_m)).inner + 1, grid_.bands() - 1);
  const double carried_m = std::max(double{grid_.center_m(outer)}, far_m) - before_m;
  const double across_m = across_slope(front) * sector_rad_ * far_m;
  ground.surface_m = 1.5 * rough_m + std::max(-front.least_slope(), 0.0) * carried_m +
                     across_m * (surface.interpolate_sectors + 1);

  // The lowest return on the front is ground if a step may lead to it, or if lost ground may be
  // found again there; then the surface rises further by the slope of what follows.
  const Heights lowest = front.rows[ground.lowest_row];
  const double run_m = far_m - before_m;
  const double uphill_m = front.least_slope() * (front.range_m - before_m);
  const double rise_m = lowest.low_m + uphill_m - rough_m;
  const bool is_step = rise_m < most_step_up_m(run_m, unseen_m(last_band));
  const bool may_be_ground = !has_ground_in_band && (is_step || rise_m < most_passable_m(run_m));
  if (may_be_ground) {
    const double half_band_m = double{grid_.deepest_band_m()} / 2;
    const double further = is_step ? 0.0 : half_band_m / double{surface.regain_length_m};
    ground.surface_m =
        std::max(ground.surface_m, lowest.high_m * (1 + further) + rough_m + across_m);
  }

  // A return on the top, in a band behind that of the front, is ground if a step may lead to it.
  const double depth_m = assumptions_.depth_m;
  const int top_band = band_of(far_m + depth_m);
  if (top_band != band) {
    const auto most_up_m = [&](double over_m) {
      return std::max(most_step_up_m(over_m, unseen_m(top_band)), most_passable_m(over_m)) +
             rough_m;
    };
    ground.most_top_m = most_up_m(run_m + depth_m) - uphill_m;
    if (may_be_ground) {
      ground.most_top_m = std::max(ground.most_top_m, lowest.high_m + most_up_m(depth_m));
    }
  }
  return ground;
}

bool DetectionBound::has_steep_step(std::size_t row, const Front& front) const {
  const elevation::AdjacentPoints::Config& adjacent = config_.adjacent_points;
  if (adjacent.rule != elevation::AdjacentRule::kSlope) return false;
  const double noise_m = assumptions_.noise_m, rough_m = assumptions_.roughness_m;
  const double steepest = std::tan(double{adjacent.max_slope_rad});
  const double aside_m = column_rad_ * front.range_m;
  const Beam& upper = beams_[row];
  return std::ranges::any_of(upper.rows_below, [&](std::size_t below) {
    const Beam& lower = beams_[below];
    const Heights at = front.rows[below];
    double rise_m = 0, run_m = 2 * noise_m;
    if (at.low_m > rough_m) {  // on the front
      rise_m = upper.start_m - lower.start_m +
               (upper.rise - lower.rise) * (front.range_m - front.half_m) -
               noise_m * (std::abs(upper.rise) + std::abs(lower.rise));
    } else {  // on the ground before it, or at its foot
      const double at_m = std::min(ground_ranges(below, front).from_m, front.range_m);
      run_m = std::max(run_m, front.range_m + front.half_m + noise_m - at_m);
      const double uphill_m = front.least_slope() * (front.range_m - at_m);
      rise_m = front.rows[row].low_m + std::min(uphill_m, 0.0) - std::max(at.high_m, rough_m);
    }
    return rise_m > double{adjacent.min_rise_m} + kRounding_m &&
           rise_m > steepest * std::hypot(run_m, aside_m) + kRounding_m;
  });
}

bool DetectionBound::stands_out(std::size_t row, const Front& front, double width_m) const {
  if (!opening_.has(static_cast<int>(row))) return false;
  const elevation::RingElevationMap::Config& map = config_.elevation_map;
  const double far_m = front.range_m + front.half_m + assumptions_.noise_m;
  const double near_m = front.range_m - front.half_m - assumptions_.noise_m;
  // The sectors in which the row meets nothing but the box, or at either end a single column of
  // ground, which counts as a lone return.
  constexpr int kAlone = 3;
  const auto covered = static_cast<int>((width_m / (column_rad_ * near_m) + kAlone) /
                                        static_cast<double>(fewest_columns_));
  const auto window = static_cast<int>(
      std::min(std::ceil(double{map.opening.window_m} / (sector_rad_ * far_m)), 1e3));
  if (covered > std::min({window, opening_.behind(), opening_.ahead()})) return false;
  // Beside the box, the row's beam meets the ground: nearest where the ground rises to that side.
  Front beside = front;
  beside.slope += across_slope(front) * std::sin(std::min((covered + 1) * sector_rad_, 1.0));
  const Ranges ground = ground_ranges(row, beside);
  if (ground.to_m > double{map.grid.range_limit_m}) return false;
  const double lower_m = (ground.from_m - far_m) * -beams_[row].rise;
  const double may_rise_m = double{map.surface.far_slope} * covered * sector_rad_ * far_m;
  return lower_m - may_rise_m > double{map.obstacle_height_m} + kRounding_m;
}

std::optional<double> DetectionBound::least_height_m(const Front& front, const Ground& ground,
                                                     double width_m) const {
  const double obstacle_m = config_.elevation_map.obstacle_height_m;
  const double raised_m = config_.adjacent_points.min_upper_height_m;
  // A row finds every box that reaches up to it, but for those whose top raises the surface, by at
  // most half its height above it, too near to the row. Tops above most_top_m raise nothing.
  std::optional<double> first_m, least_m;
  double found_to_m = 0;
  for (std::size_t row = ground.lowest_row; row < beams_.size(); ++row) {
    const Heights here = front.rows[row];
    if (here.high_m > kMostHeight_m || found_to_m > ground.most_top_m) break;
    double to_m = kNever_m;
    if (!stands_out(row, front, width_m)) {
      const double over_m = here.low_m - ground.surface_m - kRounding_m;
      if (over_m < std::min(raised_m, obstacle_m)) continue;
      const double needed_m = has_steep_step(row, front) ? raised_m : obstacle_m;
      if (over_m < needed_m) continue;
      to_m = ground.surface_m + 2 * (over_m - needed_m);
    }
    if (!first_m) first_m = here.high_m;
    if (!least_m || here.high_m > found_to_m) least_m = here.high_m;
    found_to_m = std::max(found_to_m, to_m);
  }
  if (!first_m) return std::nullopt;
  const double above_tops_m = std::max(*first_m, ground.most_top_m);
  const double height_m =
      found_to_m > ground.most_top_m ? std::min(*least_m, above_tops_m) : above_tops_m;
  return height_m <= kMostHeight_m ? std::optional(height_m) : std::nullopt;
}

std::vector<std::optional<double>> DetectionBound::least_heights_m(
    Ranges ranges, std::span<const double> widths_m) const {
  std::vector<std::optional<double>> least_m(widths_m.size());
  if (config_.elevation_map.reference != elevation::GroundReference::kLocalSurface) return least_m;
  // The ends of a wide front are farther than its middle.
  const double last_m =
      std::hypot(ranges.to_m, widths_m.empty() ? 0 : std::ranges::max(widths_m) / 2);
  for (std::size_t i = 0; i < widths_m.size(); ++i) {
    // At either end some beams of a column may miss the box.
    if (widths_m[i] >= (kFewestColumns + 1) * column_rad_ * ranges.to_m) least_m[i] = 0;
  }
  Front front{};
  const auto promises_any = [&] {
    return std::ranges::any_of(least_m, [](const auto& height_m) { return height_m.has_value(); });
  };
  for (double from_m = ranges.from_m; from_m < last_m && promises_any();
       from_m += 2 * front.half_m) {
    front.half_m = kRangeStep_m / 2 * std::max(from_m / kNear_m, 1.0);
    front.range_m = from_m + front.half_m;
    const double rise_m = 2 * assumptions_.slope * front.range_m;
    const int slopes = std::max(static_cast<int>(std::ceil(rise_m / kHeightStep_m)), 1);
    front.half_slope = assumptions_.slope / slopes;
    for (int i = 0; i < slopes; ++i) {
      front.slope = -assumptions_.slope + (2 * i + 1) * front.half_slope;
      find_rows(front);
      const std::optional<Ground> ground = ground_at(front);
      for (std::size_t width = 0; width < widths_m.size(); ++width) {
        if (!least_m[width]) continue;
        const auto here_m = ground ? least_height_m(front, *ground, widths_m[width]) : std::nullopt;
        least_m[width] = here_m ? std::optional(std::max(*least_m[width], *here_m)) : std::nullopt;
      }
    }
  }
  for (auto& height_m : least_m) {
    if (height_m) height_m = std::ceil(*height_m * 100) / 100;
  }
  return least_m;
}

}  // namespace terracut::detection
