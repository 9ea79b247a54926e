// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "plain_coarse_labels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "pipeline/stage/row_steps.hpp"

namespace terracut::test {
namespace {

using elevation::AdjacentPoints;
using elevation::AdjacentRule;
using elevation::GroundReference;
using elevation::GroundSurface;
using elevation::RingElevationMap;
using elevation::RingGrid;
using frame::ImageShape;
using frame::OverflowReturn;
using frame::RangeImage;
using ground::SegmenterConfig;

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

/// A place on the ground as seen from the sensor.
struct Place {
  double range_m = 0, z_m = 0;
  double highest_m = 0;  // z of all that was seen in its grid cell
  bool stands_out = false;
};
using LowestOfSector = std::vector<std::optional<Place>>;  // by band

template <class T>
decltype(auto) at(T& values, int index) {
  return values[static_cast<std::size_t>(index)];
}

/// One column of grid cells, from the vehicle outwards.
struct TracedSector {
  std::vector<double> z_m;        // of the trace, in the middle of each band
  std::vector<bool> is_ground;    // the band's lowest return is ground ...
  std::vector<bool> is_regained;  // ... behind a stretch on which ground was lost
};

class PlainSurface {
 public:
  PlainSurface(const GroundSurface::Config& config, double obstacle_height_m, const RingGrid& grid,
               std::vector<LowestOfSector> lowest)
      : config_(config),
        obstacle_height_m_(obstacle_height_m),
        grid_(grid),
        lowest_(std::move(lowest)) {
    for (const LowestOfSector& sector : lowest_) traced_.push_back(trace(sector));
    is_donor_.resize(traced_.size());
    for (int sector = 0; sector < grid_.sectors(); ++sector) {
      for (int band = 0; band < grid_.bands(); ++band) {
        at(is_donor_, sector)
            .push_back(at(at(traced_, sector).is_ground, band) &&
                       (!at(at(traced_, sector).is_regained, band) || is_wide(sector, band)));
      }
    }
  }

  /// Height of the surface in the middle of a band, so far across the sector: 0 at its first edge,
  /// 1 at its last.
  [[nodiscard]] double z_m(int sector, int band, double across) const {
    const double rise_m = rise_across_m(sector, band);
    return lowest_z_m(sector, band) + (rise_m > 0 ? rise_m * across : -rise_m * (1 - across));
  }

  /// Where it is lowest.
  [[nodiscard]] double lowest_z_m(int sector, int band) const {
    const TracedSector& traced = at(traced_, sector);
    if (at(at(is_donor_, sector), band)) return at(traced.z_m, band);
    double weights = 0, sum = 0;
    const int behind = std::min(config_.interpolate_sectors, (grid_.sectors() - 1) / 2);
    const int ahead = std::min(config_.sectors_ahead, behind);
    for (int away = -behind; away <= ahead; ++away) {
      const int donor = around(sector + away);
      if (away == 0 || !at(at(is_donor_, donor), band)) continue;
      weights += 1.0 / std::abs(away);
      sum += at(at(traced_, donor).z_m, band) / std::abs(away);
    }
    return weights > 0 ? sum / weights : at(traced.z_m, band);
  }

 private:
  [[nodiscard]] int around(int sector) const {
    return (sector + grid_.sectors()) % grid_.sectors();
  }

  [[nodiscard]] double sector_width_m(int band) const {
    return 2 * std::numbers::pi / grid_.sectors() * double{grid_.center_m(band)};
  }

  /// How far ground rises that the sectors on both sides have, too, and nothing tall stands on.
  [[nodiscard]] double rise_across_m(int sector, int band) const {
    const auto traced_m = [&](int s) { return at(at(traced_, around(s)).z_m, band); };
    const double left_m = traced_m(sector) - traced_m(sector - 1);
    const double right_m = traced_m(sector + 1) - traced_m(sector);
    if (left_m * right_m <= 0) return 0;
    const double least_m = std::min(std::fabs(left_m), std::fabs(right_m));
    const double rise_m = std::min({std::fabs(left_m + right_m) / 2, 2 * least_m,
                                    double{config_.max_slope} * sector_width_m(band)});
    for (int s = sector - 1; s <= sector + 1; ++s) {
      if (!at(at(is_donor_, around(s)), band)) return 0;
      const Place& seen = *at(at(lowest_, around(s)), band);
      if (seen.highest_m - seen.z_m > double{config_.tall_m} + rise_m) return 0;
    }
    return std::copysign(rise_m, left_m);
  }

  [[nodiscard]] TracedSector trace(const LowestOfSector& lowest) const {
    const auto bands = static_cast<std::size_t>(grid_.bands());
    TracedSector sector{std::vector<double>(bands), std::vector<bool>(bands),
                        std::vector<bool>(bands)};
    Place last;
    int lost = trace_from(0, 0, false, lowest, last, sector);
    while (const auto again = find_again(lost, grid_.bands(), last, lowest)) {
      last = *at(lowest, again->first);
      lost = trace_from(again->first, again->second, true, lowest, last, sector);
    }
    return sector;
  }

  /// The first ground of a sector is not much higher than the mount's plane.
  [[nodiscard]] bool may_follow(const Place& last, const Place& here) const {
    const bool is_first = last.range_m == 0;
    return !is_first ||
           here.z_m < double{config_.step_up_m} + double{config_.start_slope} * here.range_m;
  }

  /// Whether a step from the last ground to the lowest return of a band stays on the ground.
  [[nodiscard]] bool is_step(const Place& last, const Place& here, int band) const {
    if (here.stands_out || !may_follow(last, here)) return false;
    const double run_m = here.range_m - last.range_m;
    const double rise_m = here.z_m - last.z_m;
    const double unseen_m = last.range_m == 0 ? 0 : std::min(run_m, double{grid_.unseen_m(band)});
    const double most_m = double{config_.step_up_limit_m} + double{config_.far_slope} * unseen_m;
    const double up_m =
        std::min(double{config_.step_up_m} + double{config_.slope_tolerance} * run_m, most_m);
    if (rise_m >= up_m || -rise_m >= up_m + double{config_.extra_fall} * run_m) return false;
    const bool is_foot_of_something_tall = here.highest_m - here.z_m > double{config_.tall_m};
    return !(is_foot_of_something_tall && rise_m > obstacle_height_m_);
  }

  /// Returns the last band that is ground; -1 if none is.
  int trace_from(int first, double first_slope, bool regained, const LowestOfSector& lowest,
                 Place& last, TracedSector& sector) const {
    int last_band = -1;
    for (int band = first; band < grid_.bands(); ++band) {
      const double middle_m = double{grid_.center_m(band)};
      const std::optional<Place>& here = at(lowest, band);
      const bool is_ground = here && is_step(last, *here, band);
      // What would be jumped over has ground that can be found again.
      if (is_ground && here->range_m - last.range_m > double{config_.regain_length_m} &&
          find_again(last_band, band, last, lowest)) {
        return last_band;
      }
      at(sector.is_ground, band) = is_ground;
      at(sector.is_regained, band) = is_ground && regained;
      if (!is_ground) {
        at(sector.z_m, band) = last.z_m;
        continue;
      }
      const Place before = std::exchange(last, *here);
      if (last.range_m == before.range_m) {  // where ground was found again
        at(sector.z_m, band) = last.z_m + first_slope * (middle_m - last.range_m);
        last_band = band;
        continue;
      }
      const double slope = slope_of(before, last);
      // The middle of a band lies on the step that leads over it.
      if (last_band >= 0 && double{grid_.center_m(last_band)} > before.range_m) {
        at(sector.z_m, last_band) =
            before.z_m + slope * (double{grid_.center_m(last_band)} - before.range_m);
      }
      at(sector.z_m, band) =
          middle_m < last.range_m ? last.z_m + slope * (middle_m - last.range_m) : last.z_m;
      last_band = band;
    }
    return last_band;
  }

  [[nodiscard]] double slope_of(const Place& a, const Place& b) const {
    return std::clamp((b.z_m - a.z_m) / std::max(b.range_m - a.range_m, 0.4),
                      -double{config_.max_slope}, double{config_.max_slope});
  }

  /// The band where a chain of passable steps begins that is long enough before `end` and passable
  /// from `lost`, and the slope from its beginning to where it is long enough.
  [[nodiscard]] std::optional<std::pair<int, double>> find_again(
      int lost_band, int end, const Place& lost, const LowestOfSector& lowest) const {
    const auto passable = [this](const Place& a, const Place& b) {
      const double run_m = b.range_m - a.range_m, deep_m = double{grid_.deepest_band_m()};
      return std::fabs(b.z_m - a.z_m) <= (run_m < deep_m
                                              ? double{config_.max_slope} * run_m
                                              : double{config_.max_slope} * deep_m +
                                                    double{config_.far_slope} * (run_m - deep_m));
    };
    const auto leads_to = [&](const Place& start) {
      return passable(lost, start) && may_follow(lost, start);
    };
    std::vector<int> chain;
    for (int band = lost_band + 1; band < end; ++band) {
      if (!at(lowest, band) || at(lowest, band)->stands_out) continue;
      const Place& here = *at(lowest, band);
      if (!chain.empty()) {
        const Place& before = *at(lowest, chain.back());
        const bool is_astray = here.range_m - before.range_m > double{config_.regain_length_m} &&
                               !leads_to(*at(lowest, chain.front()));
        if (is_astray || !passable(before, here)) chain.clear();
      }
      chain.push_back(band);
      const Place& start = *at(lowest, chain.front());
      if (leads_to(start) && here.range_m - start.range_m >= double{config_.regain_length_m}) {
        return std::pair(chain.front(), slope_of(start, here));
      }
    }
    return std::nullopt;
  }

  /// Whether ground goes on beside it, around the circle, for regain_length_m in all.
  [[nodiscard]] bool is_wide(int sector, int band) const {
    const int enough =
        std::min({static_cast<int>(double{config_.regain_length_m} / sector_width_m(band)), 16,
                  grid_.sectors()});
    const auto is_ground = [&](int s) { return at(at(traced_, around(s)).is_ground, band); };
    int wide = 1;
    for (int s = sector + 1; s <= sector + 4 && is_ground(s); ++s) ++wide;
    for (int s = sector - 1; s >= sector - 14 && is_ground(s); --s) ++wide;
    return wide >= enough;
  }

  GroundSurface::Config config_;
  double obstacle_height_m_;
  const RingGrid& grid_;
  std::vector<LowestOfSector> lowest_;
  std::vector<TracedSector> traced_;
  std::vector<std::vector<bool>> is_donor_;
};

/// What rows show by themselves: their lone returns, and what stands out of them.
class PlainRows {
 public:
  PlainRows(const RingElevationMap::Config& config, const RingGrid& grid,
            const mount::RingProfile& profile, const RangeImage& image)
      : config_(config), grid_(grid), profile_(profile), image_(image) {
    for (int row = 0; row < image.shape().rows; ++row) {
      lowest_.emplace_back(static_cast<std::size_t>(grid.sectors()));
      for (int column = 0; column < image.shape().columns; ++column) {
        if (std::isnan(z_m(row, column)) || is_lone(row, column)) continue;
        std::optional<Place>& known = at(at(lowest_, row), grid.sector_of(column));
        const double range_m = double{image.ground_range_m()[image.shape().cell(row, column)]};
        if (!known || z_m(row, column) < known->z_m) known = Place{range_m, z_m(row, column)};
      }
    }
  }

  /// Far below a return beside it in its sector, and near the height of none.
  [[nodiscard]] bool is_lone(int row, int column) const {
    if (!has_surface() || row >= stage::rows_that_meet_ground(profile_)) return false;
    const frame::ColumnRange own = columns_of_sector(column);
    bool is_below = false, has_company = false;
    for (int c = std::max(column - 2, own.begin); c <= std::min(column + 2, own.end - 1); ++c) {
      if (c == column) continue;
      // In float, as a difference of floats may hang on its last bit.
      const float above_m = static_cast<float>(z_m(row, c)) - static_cast<float>(z_m(row, column));
      is_below |= above_m > config_.lone_depth_m;
      has_company |= std::fabs(above_m) < config_.lone_depth_m / 2;
    }
    return is_below && !has_company;
  }

  /// How far a height lies above what the row shows of the ground around a sector; NaN if the row
  /// tells nothing.
  [[nodiscard]] double standing_out_m(int row, int sector, double height_m) const {
    if (!has_surface() || !is_far_from_next(row) || !at(at(lowest_, row), sector)) return kNoHeight;
    const double width_m =
        2 * std::numbers::pi / grid_.sectors() * at(at(lowest_, row), sector)->range_m;
    const int reach =
        std::min({static_cast<int>(std::ceil(double{config_.opening.window_m} / width_m)), 8,
                  (grid_.sectors() - 1) / 2});
    const int most_ahead = std::min(4, (grid_.sectors() - 1) / 2);
    double opening_m = -std::numeric_limits<double>::infinity();
    for (int first = sector - reach; first <= sector; ++first) {
      double lowest_m = std::numeric_limits<double>::infinity();
      for (int s = first; s <= std::min(first + reach, sector + most_ahead); ++s) {
        const std::optional<Place>& seen =
            at(at(lowest_, row), (s + grid_.sectors()) % grid_.sectors());
        if (!seen) continue;
        lowest_m = std::min(lowest_m, seen->z_m + double{config_.surface.far_slope} * width_m *
                                                      std::abs(s - sector));
      }
      opening_m = std::max(opening_m, lowest_m);
    }
    return height_m - opening_m;
  }

 private:
  [[nodiscard]] bool has_surface() const {
    return config_.reference == GroundReference::kLocalSurface;
  }
  [[nodiscard]] frame::ColumnRange columns_of_sector(int column) const {
    const int sector = grid_.sector_of(column);
    return grid_.columns_of({sector, sector + 1});
  }
  [[nodiscard]] double z_m(int row, int column) const {
    const std::size_t cell = image_.shape().cell(row, column);
    return image_.has_return(cell) ? double{image_.z_m()[cell]} : kNoHeight;
  }
  [[nodiscard]] bool is_far_from_next(int row) const {
    const double own_m = at(profile_.rings, row).ground_distance_m;
    if (!std::isfinite(own_m)) return false;
    return std::ranges::none_of(profile_.rings, [&](const mount::Ring& ring) {
      return ring.ground_distance_m > own_m && ring.ground_distance_m <= own_m + 1;
    });
  }

  const RingElevationMap::Config& config_;
  const RingGrid& grid_;
  const mount::RingProfile& profile_;
  const RangeImage& image_;
  std::vector<LowestOfSector> lowest_;  // by row and sector
};

std::vector<LowestOfSector> find_lowest(const RingElevationMap::Config& config,
                                        const RingGrid& grid, const RangeImage& image,
                                        const PlainRows& rows) {
  std::vector<LowestOfSector> lowest(static_cast<std::size_t>(grid.sectors()),
                                     LowestOfSector(static_cast<std::size_t>(grid.bands())));
  constexpr int kNoRow = 255;
  std::vector<std::vector<int>> row_of_lowest(
      lowest.size(), std::vector<int>(static_cast<std::size_t>(grid.bands()), kNoRow));
  const auto take = [&](int row, int column, float z_m, float range_m) {
    const int sector = grid.sector_of(column), band = grid.band_of(range_m);
    std::optional<Place>& known = at(at(lowest, sector), band);
    // A range is kept to 15 bits.
    const float kept_m = std::bit_cast<float>(std::bit_cast<std::uint32_t>(range_m) & ~0xFFU);
    Place place{double{kept_m}, double{z_m}, double{z_m}};
    int& row_of_known = at(at(row_of_lowest, sector), band);
    const auto order = [](const Place& p, int r) { return std::tuple(p.z_m, p.range_m, r); };
    if (known) place.highest_m = std::max(place.highest_m, known->highest_m);
    if (!known || order(place, row) < order(*known, row_of_known)) {
      known = place;
      row_of_known = row;
    }
    known->highest_m = place.highest_m;
  };
  const ImageShape& shape = image.shape();
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      const std::size_t cell = shape.cell(row, column);
      if (!image.has_return(cell) || rows.is_lone(row, column)) continue;
      take(row, column, image.z_m()[cell], image.ground_range_m()[cell]);
    }
  }
  for (const OverflowReturn& extra : image.overflow()) {
    take(kNoRow, static_cast<int>(extra.cell) % shape.stride(), extra.point.z_m,
         extra.point.ground_range_m);
  }
  // A lone return is no ground, but it may be the highest of its cell.
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      const std::size_t cell = shape.cell(row, column);
      if (!image.has_return(cell) || !rows.is_lone(row, column)) continue;
      const int band = grid.band_of(image.ground_range_m()[cell]);
      std::optional<Place>& known = at(at(lowest, grid.sector_of(column)), band);
      if (known) known->highest_m = std::max(known->highest_m, double{image.z_m()[cell]});
    }
  }
  for (int sector = 0; sector < grid.sectors(); ++sector) {
    for (int band = 0; band < grid.bands(); ++band) {
      std::optional<Place>& known = at(at(lowest, sector), band);
      const int row = at(at(row_of_lowest, sector), band);
      if (!known || row == kNoRow) continue;
      known->stands_out =
          rows.standing_out_m(row, sector, known->z_m) > double{config.obstacle_height_m};
    }
  }
  return lowest;
}

/// Between the middles of two bands, at the middle of the grid's step that a range lies in.
double interpolated_m(const RingGrid& grid, const PlainSurface& surface, int column,
                      const RingGrid::Config& config, float range_m) {
  const int sector = grid.sector_of(column);
  const frame::ColumnRange columns = grid.columns_of({sector, sector + 1});
  const double across = (column - columns.begin + 0.5) / static_cast<double>(columns.size());
  const float last_step = config.range_limit_m * RingGrid::kStepsPerMetre;
  const double step = std::floor(double{std::min(range_m * RingGrid::kStepsPerMetre, last_step)});
  const double place_m = (step + 0.5) / double{RingGrid::kStepsPerMetre};
  const int band = grid.band_of(range_m);
  const double middle_m = double{grid.center_m(band)};
  const int other =
      place_m > middle_m ? std::min(band + 1, grid.bands() - 1) : std::max(band - 1, 0);
  const double here_m = surface.z_m(sector, band, across);
  if (other == band) return here_m;
  const double share = (place_m - middle_m) / (double{grid.center_m(other)} - middle_m);
  return here_m + share * (surface.z_m(sector, other, across) - here_m);
}

/// The row so many steps up; -1 if there is none.
int row_above(const mount::RingProfile& profile, int row, int steps, double step_deg) {
  const auto elevation_deg = [&](int r) {
    return at(profile.rings, r).elevation_rad * 180 / std::numbers::pi;
  };
  for (int up = row + steps; up < static_cast<int>(profile.rings.size()); ++up) {
    if (elevation_deg(up) - elevation_deg(row) >= steps * step_deg - 1e-6) return up;
  }
  return -1;
}

/// Eq. 5; 0 where the upper beam meets no ground.
double ring_spacing_m(const mount::RingProfile& profile, int lower, int upper, double slope_rad) {
  const mount::Ring& above = at(profile.rings, upper);
  if (!std::isfinite(above.ground_distance_m)) return 0;
  const auto tan_from_down = [&](int row) {
    return std::tan(std::numbers::pi / 2 + at(profile.rings, row).elevation_rad);
  };
  const double lower_tan = tan_from_down(lower), upper_tan = tan_from_down(upper);
  return std::max(0.0, (profile.mount.height_m + above.origin_height_m) * (upper_tan - lower_tan) /
                           (std::tan(slope_rad) * upper_tan + 1));
}

}  // namespace

PlainCoarseLabels::PlainCoarseLabels(const SegmenterConfig& config,
                                     const mount::RingProfile& profile, const RingGrid& grid,
                                     const RangeImage& image)
    : height_m(image.shape().cells(), kNoHeight),
      stands_out_m(height_m),
      may_be_steep(image.shape().cells()),
      must_be_steep(image.shape().cells()) {
  const ImageShape& shape = image.shape();
  const RingElevationMap::Config& map = config.elevation_map;
  const PlainRows rows(map, grid, profile, image);
  const std::vector<LowestOfSector> lowest = find_lowest(map, grid, image, rows);
  const PlainSurface surface(map.surface, double{map.obstacle_height_m}, grid, lowest);
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      const std::size_t cell = shape.cell(row, column);
      if (!image.has_return(cell)) continue;
      const float range_m = image.ground_range_m()[cell];
      const int sector = grid.sector_of(column);
      const double ground_m = map.reference == GroundReference::kCellMinimum
                                  ? at(at(lowest, sector), grid.band_of(range_m))->z_m
                                  : interpolated_m(grid, surface, column, map.grid, range_m);
      height_m[cell] = double{image.z_m()[cell]} - ground_m;
      stands_out_m[cell] = rows.standing_out_m(row, sector, double{image.z_m()[cell]});
    }
  }

  const AdjacentPoints::Config& rule = config.adjacent_points;
  const double tan_slope = std::tan(double{rule.max_slope_rad});
  const auto compare = [&](std::size_t lower, std::size_t upper, double bound_m, double slack,
                           std::vector<bool>& steep) {
    const double dx = double{image.x_m()[upper]} - double{image.x_m()[lower]};
    const double dy = double{image.y_m()[upper]} - double{image.y_m()[lower]};
    const double run_m = std::hypot(dx, dy);
    if (rule.rule == AdjacentRule::kRingSpacing) {
      if (run_m < bound_m * (1 + slack)) steep[upper] = true;
      return;
    }
    const double rise_m = double{image.z_m()[upper]} - double{image.z_m()[lower]};
    if (rise_m < double{rule.min_rise_m} - slack || run_m * tan_slope >= rise_m * (1 + slack) ||
        height_m[upper] < double{rule.min_upper_height_m} - slack) {
      return;
    }
    steep[upper] = true;
    if (height_m[lower] >= double{rule.min_lower_height_m} - slack) steep[lower] = true;
  };
  for (int row = 0; row < shape.rows; ++row) {
    for (int step = rule.first_row_step; step <= rule.last_row_step; ++step) {
      const int above = row_above(profile, row, step, double{rule.row_step_deg});
      if (above < 0) continue;
      const double bound_m = ring_spacing_m(profile, row, above, double{rule.max_slope_rad});
      for (int column = 0; column < shape.columns; ++column) {
        for (int aside = -rule.column_reach; aside <= rule.column_reach; ++aside) {
          const std::size_t lower = shape.cell(row, column);
          const std::size_t upper =
              shape.cell(above, (column + aside + shape.columns) % shape.columns);
          if (!image.has_return(lower) || !image.has_return(upper)) continue;
          constexpr double kSlack = 1e-4;  // metres, and of 1
          compare(lower, upper, bound_m, kSlack, may_be_steep);
          compare(lower, upper, bound_m, -kSlack, must_be_steep);
        }
      }
    }
  }
}

}  // namespace terracut::test
