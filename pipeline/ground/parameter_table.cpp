// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/parameter_table.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <type_traits>

namespace terracut::ground {
namespace {

constexpr std::array<std::string_view, 2> kOffOn{"no", "yes"};
constexpr std::array<std::string_view, 2> kReferences{"cell_minimum", "local_surface"};
constexpr std::array<std::string_view, 2> kAdjacentRules{"ring_spacing", "slope"};
constexpr std::array<std::string_view, 3> kCutRows{"auto", "all", "ground"};
constexpr std::array<std::string_view, 2> kRegionRules{"histogram", "height_ramp"};
constexpr std::array<std::string_view, 2> kBoundaryRules{"height_gradient", "nearness"};

// Makes the two functions that read and write one field of the configuration.
#define TERRACUT_FIELD(path)                                                     \
  [](const SegmenterConfig& c) noexcept { return static_cast<double>(c.path); }, \
      [](SegmenterConfig& c, double value) noexcept {                            \
        c.path = static_cast<std::remove_reference_t<decltype(c.path)>>(value);  \
      }

constexpr double kFar = kNoLimit;

// clang-format off: a table reads better with an entry on two lines than one word a line.
constexpr std::array kParameters{
    Parameter{"grid.columns_per_sector", "columns", "Image columns a sector of the ring grid covers", 1, 64, {},
              TERRACUT_FIELD(elevation_map.grid.columns_per_sector)},
    Parameter{"grid.min_band_m", "m", "Bands narrower than this are merged", 0, 10, {},
              TERRACUT_FIELD(elevation_map.grid.min_band_m)},
    Parameter{"grid.max_band_m", "m", "Bands wider than this are cut", 0.5, kFar, {},
              TERRACUT_FIELD(elevation_map.grid.max_band_m)},
    Parameter{"grid.range_limit_m", "m", "Everything farther belongs to the last band", 10, 250, {},
              TERRACUT_FIELD(elevation_map.grid.range_limit_m)},

    Parameter{"elevation_map.reference", "", "What heights are measured from", 0, 1, kReferences,
              TERRACUT_FIELD(elevation_map.reference)},
    Parameter{"elevation_map.obstacle_height_m", "m", "Obstacle from this height above the reference on", 0.01, 2, {},
              TERRACUT_FIELD(elevation_map.obstacle_height_m)},
    Parameter{"elevation_map.lone_depth_m", "m", "A return alone so far below those beside it in its row is a ghost, no ground", 0.01, kFar, {},
              TERRACUT_FIELD(elevation_map.lone_depth_m)},
    Parameter{"elevation_map.window_m", "m", "What is no wider than this stands out of a row that comes up to it and goes down again", 0.1, 100, {},
              TERRACUT_FIELD(elevation_map.opening.window_m)},

    Parameter{"surface.step_up_m", "m", "Rise accepted as ground at no distance", 0, 1, {},
              TERRACUT_FIELD(elevation_map.surface.step_up_m)},
    Parameter{"surface.slope_tolerance", "m/m", "Further rise or fall accepted per metre of a step", 0, 1, {},
              TERRACUT_FIELD(elevation_map.surface.slope_tolerance)},
    Parameter{"surface.step_up_limit_m", "m", "... up to this rise", 0, 5, {},
              TERRACUT_FIELD(elevation_map.surface.step_up_limit_m)},
    Parameter{"surface.far_slope", "m/m", "... and this much more per metre where rings lie farther apart than 1 m", 0, 2, {},
              TERRACUT_FIELD(elevation_map.surface.far_slope)},
    Parameter{"surface.extra_fall", "m/m", "Further fall accepted per metre", 0, 2, {},
              TERRACUT_FIELD(elevation_map.surface.extra_fall)},
    Parameter{"surface.start_slope", "m/m", "Rise per metre above the mount's plane accepted of the first ground, beside step_up_m", 0, 2, {},
              TERRACUT_FIELD(elevation_map.surface.start_slope)},
    Parameter{"surface.tall_m", "m", "Something tall is so much higher than the lowest return of its cell; there no step rises by obstacle_height_m", 0, 10, {},
              TERRACUT_FIELD(elevation_map.surface.tall_m)},
    Parameter{"surface.max_slope", "m/m", "Steepest ground", 0, 1, {},
              TERRACUT_FIELD(elevation_map.surface.max_slope)},
    Parameter{"surface.regain_length_m", "m", "Lost ground is found again where passable steps lead on so far, and it is as wide", 0.5, 1000, {},
              TERRACUT_FIELD(elevation_map.surface.regain_length_m)},
    Parameter{"surface.interpolate_sectors", "sectors", "From how many sectors behind a cell without ground is interpolated", 0, 100, {},
              TERRACUT_FIELD(elevation_map.surface.interpolate_sectors)},
    Parameter{"surface.sectors_ahead", "sectors", "... and from how many ahead, which are waited for", 0, 100, {},
              TERRACUT_FIELD(elevation_map.surface.sectors_ahead)},

    Parameter{"adjacent.rule", "", "How a step too steep for ground is told", 0, 1, kAdjacentRules,
              TERRACUT_FIELD(adjacent_points.rule)},
    Parameter{"adjacent.max_slope_rad", "rad", "K: the steepest ground", 0.05, 1.5, {},
              TERRACUT_FIELD(adjacent_points.max_slope_rad)},
    Parameter{"adjacent.first_row_step", "steps", "Nearest row compared", 1, 4, {},
              TERRACUT_FIELD(adjacent_points.first_row_step)},
    Parameter{"adjacent.last_row_step", "steps", "Farthest row compared, not below first_row_step", 1, 4, {},
              TERRACUT_FIELD(adjacent_points.last_row_step)},
    Parameter{"adjacent.row_step_deg", "deg", "Elevation a row step covers at least", 0, 5, {},
              TERRACUT_FIELD(adjacent_points.row_step_deg)},
    Parameter{"adjacent.column_reach", "columns", "Columns compared to each side", 0, 8, {},
              TERRACUT_FIELD(adjacent_points.column_reach)},
    Parameter{"adjacent.min_rise_m", "m", "slope: smaller rises are noise", 0, 1, {},
              TERRACUT_FIELD(adjacent_points.min_rise_m)},
    Parameter{"adjacent.min_upper_height_m", "m", "slope: least height of the upper return above the reference", -1, 1, {},
              TERRACUT_FIELD(adjacent_points.min_upper_height_m)},
    Parameter{"adjacent.min_lower_height_m", "m", "slope: above this the lower return is marked too", -1, kFar, {},
              TERRACUT_FIELD(adjacent_points.min_lower_height_m)},

    Parameter{"seeds.ground_share", "", "k: share of ground around a ground seed", 0, 1, {},
              TERRACUT_FIELD(seeds.ground_share)},
    Parameter{"seeds.window_rows", "steps", "Window reach up and down", 0, 8, {},
              TERRACUT_FIELD(seeds.window_rows)},
    Parameter{"seeds.window_columns", "columns", "Window reach to each side", 0, 16, {},
              TERRACUT_FIELD(seeds.window_columns)},
    Parameter{"seeds.rows", "", "Rows the MRF decides on: all, those whose beams meet the ground, or all of up to 64 (auto)", 0, 2, kCutRows,
              TERRACUT_FIELD(seeds.rows)},

    Parameter{"region.rule", "", "Where the costs of unknown returns come from", 0, 1, kRegionRules,
              TERRACUT_FIELD(region.rule)},
    Parameter{"region.lambda", "", "Weight of the region term against the boundary term", 1e-4, 1000, {},
              TERRACUT_FIELD(region.lambda)},
    Parameter{"region.bins_per_metre", "1/m", "histogram: k of Eq. 10", 0.1, 100, {},
              TERRACUT_FIELD(region.bins_per_metre)},
    Parameter{"region.even_height_m", "m", "height_ramp: ground and obstacle cost the same here", -1, 2, {},
              TERRACUT_FIELD(region.even_height_m)},
    Parameter{"region.ramp_m", "m", "height_ramp: from there to full cost", 0.001, 5, {},
              TERRACUT_FIELD(region.ramp_m)},

    Parameter{"boundary.rule", "", "What ties neighbours to the same label", 0, 1, kBoundaryRules,
              TERRACUT_FIELD(boundary.rule)},
    Parameter{"boundary.sigma", "1/m", "height_gradient: sigma of Eq. 14", 0, 1000, {},
              TERRACUT_FIELD(boundary.sigma)},
    Parameter{"boundary.scale_m", "m", "nearness: distance of weight 1/e at range 0", 0.001, 10, {},
              TERRACUT_FIELD(boundary.scale_m)},
    Parameter{"boundary.scale_per_metre", "m/m", "nearness: its growth with range", 0, 1, {},
              TERRACUT_FIELD(boundary.scale_per_metre)},

    Parameter{"min_cut.max_unknown", "cells", "Unknown cells at most that persistency may leave open; beyond, upper rows stay coarse", 0, 262144, {},
              TERRACUT_FIELD(min_cut.max_unknown)},
    Parameter{"min_cut.least_finished", "", "Share of them finished when time is up; with less all stay coarse", 0, 1, {},
              TERRACUT_FIELD(min_cut.least_finished)},

    Parameter{"returns.same_surface_range_m", "m", "A second return this near in range shares its cell's label", 0, 10, {},
              TERRACUT_FIELD(returns.same_surface_range_m)},
    Parameter{"returns.same_surface_height_m", "m", "... and this near in height", 0, 10, {},
              TERRACUT_FIELD(returns.same_surface_height_m)},

    Parameter{"road.enabled", "", "Tell the road surface from other ground", 0, 1, kOffOn,
              TERRACUT_FIELD(road.enabled)},
    Parameter{"road.vehicle_width_m", "m", "No way leads where the vehicle does not fit between edges", 0.2, 10, {},
              TERRACUT_FIELD(road.vehicle_width_m)},
    Parameter{"road.vehicle_height_m", "m", "Obstacles higher above the ground bar no way", 0.1, kFar, {},
              TERRACUT_FIELD(road.patches.clearance_height_m)},
    Parameter{"road.track_m", "m", "The way begins so far ahead of and behind the sensor", 1, 100, {},
              TERRACUT_FIELD(road.track_m)},
    Parameter{"road.max_roughness_m", "m", "Rougher ground is no road: mean departure of a height from the middle of its neighbours'", 0.0001, 1, {},
              TERRACUT_FIELD(road.terrain.max_roughness_m)},
    Parameter{"road.roughness_window_m", "m", "... over so far to either side on the ring", 0.05, 10, {},
              TERRACUT_FIELD(road.patches.roughness_window_m)},
    Parameter{"road.edge_slope", "m/m", "Along a ring steeper than this against the terrain is an edge", 0.001, 10, {},
              TERRACUT_FIELD(road.edges.slope)},
    Parameter{"road.edge_bend", "m/m", "... if the slope to neither side of it is as near to its own", 0, 10, {},
              TERRACUT_FIELD(road.edges.bend)},
    Parameter{"road.edge_width_m", "m", "... over this length", 0.05, 5, {},
              TERRACUT_FIELD(road.edges.width_m)},
    Parameter{"road.edge_neighbours", "patches", "An edge with fewer others in the rings around it is noise", 0, 20, {},
              TERRACUT_FIELD(road.edge_neighbours)},
    Parameter{"road.max_step_m", "m", "From ring to ring always level up to this", 0, 1, {},
              TERRACUT_FIELD(road.max_step_m)},
    Parameter{"road.max_step_slope", "m/m", "... and up to this slope against the terrain", 0, 10, {},
              TERRACUT_FIELD(road.max_step_slope)},
    Parameter{"road.max_gap_m", "m", "Rings farther apart are not connected", 0.1, 100, {},
              TERRACUT_FIELD(road.max_gap_m)},
    Parameter{"road.patch_deg", "deg", "Azimuth of the pieces of rings that are judged together", 0.05, 5, {},
              TERRACUT_FIELD(road.patches.width_deg)},
    Parameter{"road.terrain_square_m", "m", "The terrain's slope is a plane over three by three such squares", 1, 60, {},
              TERRACUT_FIELD(road.terrain.square_m)},

};
// clang-format on
#undef TERRACUT_FIELD

}  // namespace

std::span<const Parameter> parameters() noexcept {
  return kParameters;
}

bool is_read(const Parameter& parameter, const SegmenterConfig& config) noexcept {
  using elevation::AdjacentRule, elevation::GroundReference;
  using random_field::BoundaryRule, random_field::RegionRule;
  const bool has_surface = config.elevation_map.reference == GroundReference::kLocalSurface;
  const bool has_ramp = config.region.rule == RegionRule::kHeightRamp;
  const bool has_nearness = config.boundary.rule == BoundaryRule::kNearness;
  struct Reader {
    std::string_view keys;  // beginning of the keys
    bool is_in_use;
  };
  const std::array readers{
      Reader{"surface.", has_surface},
      Reader{"elevation_map.lone", has_surface},
      Reader{"elevation_map.window", has_surface},
      Reader{"adjacent.min_", config.adjacent_points.rule == AdjacentRule::kSlope},
      Reader{"region.even", has_ramp},
      Reader{"region.ramp", has_ramp},
      Reader{"region.bins", !has_ramp},
      Reader{"region.empty", !has_ramp},
      Reader{"boundary.scale", has_nearness},
      Reader{"boundary.sigma", !has_nearness},
      Reader{"boundary.min", !has_nearness},
  };
  return std::ranges::none_of(readers, [&](const Reader& reader) {
    return !reader.is_in_use && parameter.key.starts_with(reader.keys);
  });
}

Status set_parameter(SegmenterConfig& config, std::string_view key, std::string_view value) {
  const Parameter* parameter = find_parameter(parameters(), key);
  if (parameter == nullptr) return unknown_parameter(key, keys_of(parameters()));
  return parameter->read(config, value);
}

Status apply_setting(SegmenterConfig& config, std::string_view setting) {
  const auto parts = parts_of_setting(setting);
  return parts ? set_parameter(config, parts->key, parts->value)
               : tl::unexpected<Error>(parts.error());
}

}  // namespace terracut::ground
