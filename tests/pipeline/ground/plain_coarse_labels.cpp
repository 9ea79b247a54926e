// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "plain_coarse_labels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

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
  PlainSurface(const GroundSurface::Config& config, const RingGrid& grid,
               std::vector<LowestOfSector> lowest)
      : config_(config), grid_(grid), lowest_(std::move(lowest)) {
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
    double weights = double{config_.traced_weight};
    double sum = weights * at(traced.z_m, band);
    const int reach = std::min(config_.interpolate_sectors, (grid_.sectors() - 1) / 2);
    for (int away = -reach; away <= reach; ++away) {
      const int donor = around(sector + away);
      if (away == 0 || !at(at(is_donor_, donor), band)) continue;
      weights += 1.0 / std::abs(away);
      sum += at(at(traced_, donor).z_m, band) / std::abs(away);
    }
    return sum / weights;
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
                                    double{config_.max_cross_slope} * sector_width_m(band)});
    for (int s = sector - 1; s <= sector + 1; ++s) {
      if (!at(at(is_donor_, around(s)), band)) return 0;
      const Place& seen = *at(at(lowest_, around(s)), band);
      if (seen.highest_m - seen.z_m > double{config_.tall_m} + rise_m) return 0;
    }
    return std::copysign(rise_m, left_m);
  }

  [[nodiscard]] double expected_m(const Place& last, double slope, double range_m) const {
    return last.z_m + slope * std::min(range_m - last.range_m, double{config_.slope_memory_m});
  }

  [[nodiscard]] double steepest(double slope) const {
    return std::clamp(slope, -double{config_.max_slope}, double{config_.max_slope});
  }

  [[nodiscard]] TracedSector trace(const LowestOfSector& lowest) const {
    const auto bands = static_cast<std::size_t>(grid_.bands());
    TracedSector sector{std::vector<double>(bands), std::vector<bool>(bands),
                        std::vector<bool>(bands)};
    Place last;
    double slope = 0;
    int lost = trace_from(0, false, lowest, last, slope, sector);
    while (const auto again = find_again(lost, grid_.bands(), last, lowest)) {
      last = *at(lowest, again->first);
      slope = again->second;
      lost = trace_from(again->first, true, lowest, last, slope, sector);
    }
    return sector;
  }

  /// The first ground of a sector is not much higher than the mount's plane.
  [[nodiscard]] bool may_follow(const Place& last, const Place& here) const {
    const bool is_first = last.range_m == 0;
    return !is_first ||
           here.z_m < double{config_.step_up_m} + double{config_.start_slope} * here.range_m;
  }

  /// Returns the last band that is ground; -1 if none is.
  int trace_from(int first, bool regained, const LowestOfSector& lowest, Place& last, double& slope,
                 TracedSector& sector) const {
    int last_band = -1;
    for (int band = first; band < grid_.bands(); ++band) {
      const double middle_m = double{grid_.center_m(band)};
      const std::optional<Place>& here = at(lowest, band);
      bool is_ground = false;
      if (here) {
        const double run_m = here->range_m - last.range_m;
        const double off_m = here->z_m - expected_m(last, slope, here->range_m);
        const double up_m =
            std::min(double{config_.step_up_m} + double{config_.slope_tolerance} * run_m,
                     double{config_.step_up_limit_m});
        const bool is_foot_of_something_tall = off_m > double{config_.foot_rise_m} &&
                                               here->highest_m - here->z_m > double{config_.tall_m};
        is_ground = off_m < up_m && -off_m < up_m + double{config_.extra_fall} * run_m &&
                    !is_foot_of_something_tall && may_follow(last, *here);
      }
      // What would be jumped over has ground that can be found again.
      if (is_ground && here->range_m - last.range_m > double{config_.regain_length_m} &&
          find_again(last_band, band, last, lowest)) {
        return last_band;
      }
      at(sector.is_ground, band) = is_ground;
      at(sector.is_regained, band) = is_ground && regained;
      if (!is_ground) {
        at(sector.z_m, band) = expected_m(last, slope, middle_m);
        continue;
      }
      const Place before = std::exchange(last, *here);
      const double run_m =
          std::max(last.range_m - before.range_m, double{config_.first_slope_run_m});
      const double step_slope = steepest((last.z_m - before.z_m) / run_m);
      const double gain = double{config_.slope_gain};
      slope = steepest((1 - gain) * slope + gain * step_slope);
      // The middle of a band lies on the step that leads over it.
      if (last_band >= 0 && double{grid_.center_m(last_band)} > before.range_m) {
        at(sector.z_m, last_band) =
            before.z_m + step_slope * (double{grid_.center_m(last_band)} - before.range_m);
      }
      at(sector.z_m, band) = middle_m < last.range_m
                                 ? last.z_m + step_slope * (middle_m - last.range_m)
                                 : expected_m(last, slope, middle_m);
      last_band = band;
    }
    return last_band;
  }

  /// The band where a chain of passable steps begins that is long enough before `end` and passable
  /// from `lost`, and the slope from its beginning to where it is long enough.
  [[nodiscard]] std::optional<std::pair<int, double>> find_again(
      int lost_band, int end, const Place& lost, const LowestOfSector& lowest) const {
    const auto passable = [this](const Place& a, const Place& b) {
      return std::fabs(b.z_m - a.z_m) <= double{config_.regain_slope} * (b.range_m - a.range_m);
    };
    const auto leads_to = [&](const Place& start) {
      return passable(lost, start) && may_follow(lost, start);
    };
    std::vector<int> chain;
    for (int band = lost_band + 1; band < end; ++band) {
      if (!at(lowest, band)) continue;
      const Place& here = *at(lowest, band);
      if (!chain.empty()) {
        const Place& before = *at(lowest, chain.back());
        const double step_m = here.range_m - before.range_m;
        const bool is_astray =
            step_m > double{config_.unconnected_gap_m} && !leads_to(*at(lowest, chain.front()));
        if (is_astray || step_m > double{config_.regain_gap_m} || !passable(before, here)) {
          chain.clear();
        }
      }
      chain.push_back(band);
      const Place& start = *at(lowest, chain.front());
      const double length_m = here.range_m - start.range_m;
      if (leads_to(start) && length_m >= double{config_.regain_length_m}) {
        return std::pair(chain.front(), steepest((here.z_m - start.z_m) / length_m));
      }
    }
    return std::nullopt;
  }

  /// Whether ground goes on beside it, around the circle, for regain_width_m in all.
  [[nodiscard]] bool is_wide(int sector, int band) const {
    const int enough = std::min(
        static_cast<int>(double{config_.regain_width_m} / sector_width_m(band)), grid_.sectors());
    const auto is_ground = [&](int s) { return at(at(traced_, around(s)).is_ground, band); };
    int wide = 1;
    for (int s = sector + 1; wide < enough && is_ground(s); ++s) ++wide;
    for (int s = sector - 1; wide < enough && is_ground(s); --s) ++wide;
    return wide >= enough;
  }

  GroundSurface::Config config_;
  const RingGrid& grid_;
  std::vector<LowestOfSector> lowest_;
  std::vector<TracedSector> traced_;
  std::vector<std::vector<bool>> is_donor_;
};

std::vector<LowestOfSector> find_lowest(const RingGrid& grid, const RangeImage& image) {
  std::vector<LowestOfSector> lowest(static_cast<std::size_t>(grid.sectors()),
                                     LowestOfSector(static_cast<std::size_t>(grid.bands())));
  const auto take = [&](int column, float z_m, float range_m) {
    std::optional<Place>& known = at(at(lowest, grid.sector_of(column)), grid.band_of(range_m));
    Place place{double{range_m}, double{z_m}, double{z_m}};
    const auto order = [](const Place& p) { return std::pair(p.z_m, p.range_m); };
    if (known) place.highest_m = std::max(place.highest_m, known->highest_m);
    if (!known || order(place) < order(*known)) known = place;
    known->highest_m = place.highest_m;
  };
  const ImageShape& shape = image.shape();
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      const std::size_t cell = shape.cell(row, column);
      if (image.has_return(cell)) take(column, image.z_m()[cell], image.ground_range_m()[cell]);
    }
  }
  for (const OverflowReturn& extra : image.overflow()) {
    take(static_cast<int>(extra.cell) % shape.stride(), extra.point.z_m,
         extra.point.ground_range_m);
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

/// Which low returns count as level.
class PlainLevelling {
 public:
  PlainLevelling(const RingElevationMap::Config& config, const RingGrid& grid,
                 const RangeImage& image, const std::vector<LowestOfSector>& lowest,
                 const PlainSurface& surface)
      : config_(config), grid_(grid), image_(image), lowest_(lowest), surface_(surface) {}

  /// `slack_m` more, or less, is granted at each bound; a bend is measured a hundred times better.
  [[nodiscard]] bool is_level(int row, int column, double height_m, double slack_m) const {
    const elevation::RoughGround::Config& rough = config_.rough;
    const bool has_surface = config_.reference == GroundReference::kLocalSurface;
    if (!rough.enabled || !has_surface || !(height_m > -slack_m)) return false;
    const int sector = grid_.sector_of(column);
    const float range_m = image_.ground_range_m()[image_.shape().cell(row, column)];
    const double highest_m = highest_near_m(sector, grid_.mix_of(range_m).inner);
    if (height_m < double{config_.obstacle_height_m} + slack_m &&
        highest_m <= double{rough.tall_m} + slack_m) {
      return true;
    }
    return height_m < double{rough.rough_height_m} + slack_m &&
           highest_m <= double{rough.rough_tall_m} + slack_m &&
           is_rough(row, sector, slack_m / 100);
  }

 private:
  [[nodiscard]] int around(int sector) const {
    return (sector + grid_.sectors()) % grid_.sectors();
  }
  template <class Visit>
  void for_each_sector_near(int sector, Visit visit) const {
    const int reach = std::min(config_.rough.near_sectors, (grid_.sectors() - 1) / 2);
    for (int away = -reach; away <= reach; ++away) visit(around(sector + away));
  }
  /// Above the ground of the grid cell.
  [[nodiscard]] double highest_near_m(int sector, int band) const {
    const int reach = config_.rough.near_bands;
    double highest_m = -std::numeric_limits<double>::infinity();
    for_each_sector_near(sector, [&](int near) {
      for (int b = band - reach; b <= band + 1 + reach; ++b) {
        if (b < 0 || b >= grid_.bands() || !at(at(lowest_, near), b)) continue;
        highest_m = std::max(highest_m, at(at(lowest_, near), b)->highest_m);
      }
    });
    return highest_m - surface_.lowest_z_m(sector, band);
  }
  [[nodiscard]] double z_m(int row, int column) const {
    const std::size_t cell = image_.shape().cell(row, column);
    return image_.has_return(cell) ? double{image_.z_m()[cell]} : kNoHeight;
  }
  [[nodiscard]] bool is_rough(int row, int sector, double slack_m) const {
    int known = 0, rough = 0;
    for (int r = std::max(row - 2, 0); r <= std::min(row + 2, image_.shape().rows - 1); ++r) {
      for_each_sector_near(sector, [&](int near) {
        const frame::ColumnRange columns = grid_.columns_of({near, near + 1});
        for (int c = columns.begin + 1; c + 1 < columns.end; ++c) {
          const double bend_m = std::fabs(z_m(r, c - 1) + z_m(r, c + 1) - 2 * z_m(r, c));
          known += std::isnan(bend_m) ? 0 : 1;
          rough += bend_m > double{config_.rough.rough_m} - slack_m ? 1 : 0;
        }
      });
    }
    return 2 * rough > known;
  }

  const RingElevationMap::Config& config_;
  const RingGrid& grid_;
  const RangeImage& image_;
  const std::vector<LowestOfSector>& lowest_;
  const PlainSurface& surface_;
};

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
    : least_height_m(image.shape().cells(), kNoHeight),
      most_height_m(least_height_m),
      may_be_steep(image.shape().cells()),
      must_be_steep(image.shape().cells()) {
  const ImageShape& shape = image.shape();
  const RingElevationMap::Config& map = config.elevation_map;
  const std::vector<LowestOfSector> lowest = find_lowest(grid, image);
  const PlainSurface surface(map.surface, grid, lowest);
  const PlainLevelling levelling(map, grid, image, lowest, surface);
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      const std::size_t cell = shape.cell(row, column);
      if (!image.has_return(cell)) continue;
      const float range_m = image.ground_range_m()[cell];
      const int sector = grid.sector_of(column);
      const double ground_m = map.reference == GroundReference::kCellMinimum
                                  ? at(at(lowest, sector), grid.band_of(range_m))->z_m
                                  : interpolated_m(grid, surface, column, map.grid, range_m);
      const double height_m = double{image.z_m()[cell]} - ground_m;
      constexpr double kSlack_m = 1e-3;
      const bool may_be_level = levelling.is_level(row, column, height_m, kSlack_m);
      const bool must_be_level = levelling.is_level(row, column, height_m, -kSlack_m);
      least_height_m[cell] = may_be_level ? std::min(height_m, 0.0) : height_m;
      most_height_m[cell] = must_be_level ? 0 : std::max(height_m, may_be_level ? 0 : height_m);
    }
  }

  const AdjacentPoints::Config& rule = config.adjacent_points;
  const double tan_slope = std::tan(double{rule.max_slope_rad});
  const auto compare = [&](std::size_t lower, std::size_t upper, double bound_m, double slack,
                           const std::vector<double>& height_m, std::vector<bool>& steep) {
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
          compare(lower, upper, bound_m, kSlack, most_height_m, may_be_steep);
          compare(lower, upper, bound_m, -kSlack, least_height_m, must_be_steep);
        }
      }
    }
  }
}

}  // namespace terracut::test
