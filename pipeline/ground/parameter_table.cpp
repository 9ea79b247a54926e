// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/parameter_table.hpp"

#include <array>
#include <type_traits>

namespace terracut::ground {
namespace {

constexpr std::array<std::string_view, 2> kOffOn{"no", "yes"};
constexpr std::array<std::string_view, 2> kReferences{"cell_minimum", "local_surface"};
constexpr std::array<std::string_view, 2> kAdjacentRules{"ring_spacing", "slope"};
constexpr std::array<std::string_view, 3> kCutRows{"auto", "all", "ground"};
constexpr std::array<std::string_view, 2> kRegionRules{"histogram", "height_ramp"};
constexpr std::array<std::string_view, 2> kBoundaryRules{"height_gradient", "nearness"};

// The pair of functions that read and write one field of the configuration.
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

    Parameter{"surface.step_up_m", "m", "Rise accepted as ground at no distance", 0, 1, {},
              TERRACUT_FIELD(elevation_map.surface.step_up_m)},
    Parameter{"surface.slope_tolerance", "m/m", "Further rise or fall accepted per metre traced", 0, 1, {},
              TERRACUT_FIELD(elevation_map.surface.slope_tolerance)},
    Parameter{"surface.step_up_limit_m", "m", "Largest rise ever accepted in one step", 0, 5, {},
              TERRACUT_FIELD(elevation_map.surface.step_up_limit_m)},
    Parameter{"surface.start_slope", "m/m", "Rise per metre above the mount's plane accepted of the first ground, beside step_up_m", 0, 2, {},
              TERRACUT_FIELD(elevation_map.surface.start_slope)},
    Parameter{"surface.foot_rise_m", "m", "Largest rise accepted where something tall stands", 0, kFar, {},
              TERRACUT_FIELD(elevation_map.surface.foot_rise_m)},
    Parameter{"surface.tall_m", "m", "... which is this much higher than the lowest return of its cell", 0, 10, {},
              TERRACUT_FIELD(elevation_map.surface.tall_m)},
    Parameter{"surface.extra_fall", "m/m", "Further fall accepted per metre traced", 0, 2, {},
              TERRACUT_FIELD(elevation_map.surface.extra_fall)},
    Parameter{"surface.slope_gain", "", "Share of a new step in the running slope", 0.01, 1, {},
              TERRACUT_FIELD(elevation_map.surface.slope_gain)},
    Parameter{"surface.max_slope", "m/m", "Largest running slope", 0, 1, {},
              TERRACUT_FIELD(elevation_map.surface.max_slope)},
    Parameter{"surface.slope_memory_m", "m", "How far the running slope is carried over missing ground", 0, 50, {},
              TERRACUT_FIELD(elevation_map.surface.slope_memory_m)},
    Parameter{"surface.first_slope_run_m", "m", "Shorter steps count as this long for the slope", 0.1, 10, {},
              TERRACUT_FIELD(elevation_map.surface.first_slope_run_m)},
    Parameter{"surface.regain_length_m", "m", "Lost ground is found again after so many metres of passable steps", 0.5, 1000, {},
              TERRACUT_FIELD(elevation_map.surface.regain_length_m)},
    Parameter{"surface.regain_slope", "m/m", "... that begin no steeper than this from the last ground ...", 0, 2, {},
              TERRACUT_FIELD(elevation_map.surface.regain_slope)},
    Parameter{"surface.regain_gap_m", "m", "... without a longer step among them ...", 0.5, kFar, {},
              TERRACUT_FIELD(elevation_map.surface.regain_gap_m)},
    Parameter{"surface.unconnected_gap_m", "m", "... (a way that began steeper ends at a longer step) ...", 0.5, kFar, {},
              TERRACUT_FIELD(elevation_map.surface.unconnected_gap_m)},
    Parameter{"surface.regain_width_m", "m", "... on a strip at least so wide", 0, 100, {},
              TERRACUT_FIELD(elevation_map.surface.regain_width_m)},
    Parameter{"surface.interpolate_sectors", "sectors", "How far to each side a cell without ground is interpolated from", 0, 100, {},
              TERRACUT_FIELD(elevation_map.surface.interpolate_sectors)},
    Parameter{"surface.traced_weight", "", "Weight of the traced prediction when interpolating", 0.01, 10, {},
              TERRACUT_FIELD(elevation_map.surface.traced_weight)},
    Parameter{"surface.max_cross_slope", "m/m", "Steepest ground across a sector, where nothing tall stands; 0: one height for all of it", 0, 2, {},
              TERRACUT_FIELD(elevation_map.surface.max_cross_slope)},

    Parameter{"rough.enabled", "", "Low returns with nothing tall near are level, higher ones where it is rough", 0, 1, kOffOn,
              TERRACUT_FIELD(elevation_map.rough.enabled)},
    Parameter{"rough.tall_m", "m", "Something so high above the reference is tall ...", 0, 10, {},
              TERRACUT_FIELD(elevation_map.rough.tall_m)},
    Parameter{"rough.near_sectors", "sectors", "... and near if it is so many sectors aside or fewer ...", 0, 100, {},
              TERRACUT_FIELD(elevation_map.rough.near_sectors)},
    Parameter{"rough.near_bands", "bands", "... and as many bands nearer or farther", 0, 100, {},
              TERRACUT_FIELD(elevation_map.rough.near_bands)},
    Parameter{"rough.rough_m", "m", "It is rough where rings bend more from column to column: there ...", 0, 1, {},
              TERRACUT_FIELD(elevation_map.rough.rough_m)},
    Parameter{"rough.rough_tall_m", "m", "... only something so high is tall ...", 0, 10, {},
              TERRACUT_FIELD(elevation_map.rough.rough_tall_m)},
    Parameter{"rough.rough_height_m", "m", "... and obstacles begin so high above the reference", 0, 10, {},
              TERRACUT_FIELD(elevation_map.rough.rough_height_m)},

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
    Parameter{"seeds.row_step_deg", "deg", "Elevation a row step covers at least", 0, 5, {},
              TERRACUT_FIELD(seeds.row_step_deg)},
    Parameter{"seeds.window_columns", "columns", "Window reach to each side", 0, 16, {},
              TERRACUT_FIELD(seeds.window_columns)},
    Parameter{"seeds.max_ground_height_m", "m", "Ground seeds lie no higher above the reference", 0, kFar, {},
              TERRACUT_FIELD(seeds.max_ground_height_m)},
    Parameter{"seeds.min_obstacle_height_m", "m", "Obstacles from this height on are seeds without being steep", 0, kFar, {},
              TERRACUT_FIELD(seeds.min_obstacle_height_m)},
    Parameter{"seeds.trust_all_obstacles", "", "Every obstacle of the stages before is a seed", 0, 1, kOffOn,
              TERRACUT_FIELD(seeds.trust_all_obstacles)},
    Parameter{"seeds.rows", "", "Rows the MRF decides on: all, those whose beams meet the ground, or all of up to 64 (auto)", 0, 2, kCutRows,
              TERRACUT_FIELD(seeds.rows)},

    Parameter{"region.rule", "", "Where the costs of unknown returns come from", 0, 1, kRegionRules,
              TERRACUT_FIELD(region.rule)},
    Parameter{"region.lambda", "", "Weight of the region term against the boundary term", 1e-4, 1000, {},
              TERRACUT_FIELD(region.lambda)},
    Parameter{"region.bins_per_metre", "1/m", "histogram: k of Eq. 10", 0.1, 100, {},
              TERRACUT_FIELD(region.bins_per_metre)},
    Parameter{"region.empty_bin_count", "returns", "histogram: floor of every bin", 1e-6, 1000, {},
              TERRACUT_FIELD(region.empty_bin_count)},
    Parameter{"region.even_height_m", "m", "height_ramp: ground and obstacle cost the same here", -1, 2, {},
              TERRACUT_FIELD(region.even_height_m)},
    Parameter{"region.ramp_m", "m", "height_ramp: from there to full cost", 0.001, 5, {},
              TERRACUT_FIELD(region.ramp_m)},

    Parameter{"boundary.rule", "", "What ties neighbours to the same label", 0, 1, kBoundaryRules,
              TERRACUT_FIELD(boundary.rule)},
    Parameter{"boundary.sigma", "1/m", "height_gradient: sigma of Eq. 14", 0, 1000, {},
              TERRACUT_FIELD(boundary.sigma)},
    Parameter{"boundary.min_distance_m", "m", "height_gradient: floor of d in Eq. 14", 0.001, 1, {},
              TERRACUT_FIELD(boundary.min_distance_m)},
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
    Parameter{"returns.obstacle_height_m", "m", "Else it is an obstacle from this height on", 0.01, 2, {},
              TERRACUT_FIELD(returns.obstacle_height_m)},

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

    Parameter{"sparse.from_deg", "deg", "Rows so far apart, 2 to 10 degrees below the horizon, are sparse: what follows holds for them", 0, 90, {},
              TERRACUT_FIELD(sparse.from_deg)},
    Parameter{"sparse.step_up_limit_m", "m", "In place of surface.step_up_limit_m", 0, 5, {},
              TERRACUT_FIELD(sparse.step_up_limit_m)},
    Parameter{"sparse.regain_gap_m", "m", "In place of surface.regain_gap_m", 0.5, kFar, {},
              TERRACUT_FIELD(sparse.regain_gap_m)},
    Parameter{"sparse.min_lower_height_m", "m", "In place of adjacent.min_lower_height_m", -1, kFar, {},
              TERRACUT_FIELD(sparse.min_lower_height_m)},
};
// clang-format on
#undef TERRACUT_FIELD

}  // namespace

std::span<const Parameter> parameters() noexcept {
  return kParameters;
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
