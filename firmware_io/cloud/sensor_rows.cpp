// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/sensor_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "firmware_io/cloud/azimuth_step.hpp"
#include "firmware_io/cloud/elevation_comb.hpp"
#include "firmware_io/scan/ring_fit_of_scans.hpp"

namespace terracut::cloud {
namespace {

using scan::kNoRing;
using scan::RingRecovery;
using scan::RingTable;
using scan::RingTableFit;

/// If two tables explain the points equally well to within this, the table whose beams start at the
/// origin is taken, as most sensors' beams do. The lowest beams see only near ground, where a
/// higher start looks the same as a higher elevation.
constexpr double kAlike_m = 0.01;

Expected<scan::FittedRings> simplest_fit(const RingTableFit& fit, std::size_t lasers) {
  const RingTable from_origin(lasers);
  auto plain = fit.fit(&from_origin);
  if (!plain) return fit.fit_seen(from_origin);
  auto free = fit.fit();
  if (free && free->residual.p95_m + kAlike_m < plain->residual.p95_m) return free;
  return plain;
}

/// Checks that most rings look lower than the ring above them. This fails if the driver was not
/// told the lasers' angles (all points lie on one plane), or if the numbers are no laser numbers
/// (each "laser" has points of all).
Status check_apart(const scan::FittedRings& rings) {
  if (rings.with_line < 2 || 4 * rings.coinciding < 3 * (rings.with_line - 1)) return {};
  return fail(ErrorCode::kMalformed,
              fmt::format("{} of {} lasers look the same way as the one above them: had the driver "
                          "the lasers' angles, are the numbers the lasers', are WIDTH and HEIGHT "
                          "exchanged, is z not along the sensor's axis?",
                          rings.coinciding, rings.with_line));
}

/// Calls `use` with some of the clouds, evenly spread over the sequence.
Status for_some(std::size_t clouds, const ReadCloud& read,
                const std::function<Status(const CloudView&)>& use) {
  return scan::read_some_scans(clouds, [&](std::size_t index) -> Status {
    const auto cloud = read(index);
    if (!cloud) return tl::unexpected(cloud.error());
    return use(*cloud);
  });
}

void find_by_number(std::span<const scan::ScanPoint> points,
                    std::span<const std::uint16_t> laser_of_point, const RingOfLaser& ring_of_laser,
                    std::vector<std::int16_t>& ring_of_point) {
  ring_of_point.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t laser = laser_of_point[i];
    const bool known = laser < ring_of_laser.size() && scan::is_place(points[i]);
    ring_of_point[i] = known ? ring_of_laser[laser] : kNoRing;
  }
}

Expected<SensorRows> learn_by_number(RowSource source, std::size_t lasers, std::size_t clouds,
                                     const ReadCloud& read) {
  if (lasers < kFewestLasers || lasers > kMostLasers) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{} lasers by {}; expected {} to {}", lasers, description_of(source),
                            kFewestLasers, kMostLasers));
  }
  std::vector<std::uint16_t> by_place;
  auto fitted = fit_numbered_lasers(lasers, clouds, [&](std::size_t index) -> Expected<CloudView> {
    auto cloud = read(index);
    if (!cloud || source == RowSource::kLaserNumbers) return cloud;
    by_place.resize(cloud->points.size());
    if (!cloud->is_organised()) {
      return fail(ErrorCode::kMalformed, "a cloud that is not organised among others that are");
    }
    const OrganisedLasers organised(*cloud);
    for (std::size_t i = 0; i < by_place.size(); ++i) {
      by_place[i] = static_cast<std::uint16_t>(organised.of(i));
    }
    return CloudView{cloud->points, by_place, cloud->rows};
  });
  if (!fitted) return tl::unexpected(fitted.error());
  return SensorRows{source, std::move(fitted->rings), std::move(fitted->ring_of_laser), 0};
}

/// Collects the laser numbers in use. Where a beam had no return, drivers write -1, which is 255 in
/// a byte.
void add_numbers(const CloudView& cloud, std::vector<bool>& numbers) {
  constexpr std::size_t kNone = 255;
  for (std::size_t i = 0; i < cloud.laser.size(); ++i) {
    const std::size_t laser = cloud.laser[i];
    if (laser == kNone && !scan::is_place(cloud.points[i])) continue;
    if (laser >= numbers.size()) numbers.resize(laser + 1);
    numbers[laser] = true;
  }
}

Expected<SensorRows> learn_by_order(std::size_t clouds, const ReadCloud& read) {
  RingRecovery rings;
  auto fitted = scan::fit_rings_of_scans(
      clouds, [&](std::size_t index, const RingTable* table, RingTableFit& fit) -> Status {
        const auto cloud = read(index);
        if (!cloud) return tl::unexpected(cloud.error());
        Status recovered = scan::recover_rings(cloud->points, table, rings);
        if (recovered) fit.add(cloud->points, rings.ring_of_point);
        return recovered;
      });
  if (!fitted) return tl::unexpected(fitted.error());
  if (Status apart = check_apart(*fitted); !apart) return tl::unexpected(apart.error());
  return SensorRows{RowSource::kKittiOrder, *std::move(fitted), {}, 0};
}

Expected<SensorRows> learn_by_comb(std::size_t clouds, const ReadCloud& read) {
  ElevationComb comb;
  const Status looked = for_some(clouds, read, [&](const CloudView& cloud) -> Status {
    comb.add(cloud.points);
    return {};
  });
  if (!looked) return tl::unexpected(looked.error());
  const auto elevations = comb.elevations_rad();
  if (!elevations) return tl::unexpected(elevations.error());
  SensorRows rows{RowSource::kElevations, {}, {}, 0};
  for (const double elevation_rad : *elevations) rows.rings.table.push_back({elevation_rad, 0});
  return rows;
}

/// Learns an HDL-64E's rows from the known directions of its beams. They start in two places, one
/// above the other, so that the points form no comb.
Expected<SensorRows> learn_by_hdl64e_lines(std::size_t clouds, const ReadCloud& read) {
  const RingTable nominal = scan::ring_table(hdl64e::nominal_hdl64e());
  SensorRows rows{RowSource::kElevations, {nominal, {}, {}, true}, {}, 0};
  for (int round = 0; round < 3; ++round) {
    const NearestRing nearest(rows.rings.table);
    RingTableFit fit;
    std::vector<std::int16_t> ring_of_point;
    const Status looked = for_some(clouds, read, [&](const CloudView& cloud) -> Status {
      ring_of_point.clear();
      for (const scan::ScanPoint& point : cloud.points) ring_of_point.push_back(nearest(point));
      fit.add(cloud.points, ring_of_point);
      return {};
    });
    if (!looked) return tl::unexpected(looked.error());
    auto fitted = fit.fit(&nominal);
    if (!fitted) return tl::unexpected(fitted.error());
    rows.rings = *std::move(fitted);
    rows.rings.from_nominal_table = true;
  }
  return rows;
}

/// Returns the share of points whose elevation differs from the nearest ring's by less than a
/// quarter of the step between rings; about half if the points form no rings.
double share_near_lines(const RingTable& table, std::span<const scan::ScanPoint> points) {
  const NearestRing nearest(table);
  std::size_t near = 0, all = 0;
  for (const scan::ScanPoint& point : points) {
    if (!scan::is_place(point)) continue;
    ++all;
    const std::int16_t ring = nearest(point);
    if (ring == kNoRing) continue;
    const auto i = static_cast<std::size_t>(ring);
    const std::size_t beside = i + 1 < table.size() ? i + 1 : i - 1;
    const double above_m = table[i].height_above_m(point);
    const double apart_m = std::abs(above_m - table[beside].height_above_m(point));
    near += 4 * std::abs(above_m) < apart_m ? 1U : 0U;
  }
  return static_cast<double>(near) / static_cast<double>(std::max<std::size_t>(all, 1));
}

/// Learns rows from positions alone. Rings whose points do not show a line, because they see only
/// the floor, are still found in the comb. `first` is the index of a cloud that can be read;
/// `no_number` says, for the message, why points have no laser number.
Expected<SensorRows> learn_from_places(std::size_t first, std::size_t clouds, const ReadCloud& read,
                                       const std::string& no_number) {
  RingRecovery rings;
  const bool in_kittis_order = scan::split_into_rings(read(first)->points, rings).has_value();
  const bool has_all_rings = in_kittis_order && rings.rings == scan::kScanRings;
  auto ordered = has_all_rings ? learn_by_order(clouds, read) : Expected<SensorRows>{};
  if (has_all_rings && ordered && ordered->rings.coinciding == 0) return ordered;
  auto comb = learn_by_comb(clouds, read);
  if (comb) return comb;
  if (has_all_rings) return ordered;
  if (in_kittis_order) {
    if (auto torn = learn_by_order(clouds, read)) return torn;
  }
  constexpr double kLeastNearLines = 0.56;
  auto lines = learn_by_hdl64e_lines(clouds, read);
  if (lines && share_near_lines(lines->rings.table, read(first)->points) >= kLeastNearLines)
    return lines;
  return fail(ErrorCode::kUnsupported,
              fmt::format("nothing tells which laser measured a point: {}, not organised, not in "
                          "the order of KITTI's files, and {}; give a cloud of one revolution with "
                          "the number of each point's laser",
                          no_number, comb.error().message));
}

void find_by_place(const NearestRing& nearest, std::span<const scan::ScanPoint> points,
                   std::vector<std::int16_t>& ring_of_point) {
  ring_of_point.resize(points.size());
  // std::cref() avoids a copy of the table.
  std::ranges::transform(points, ring_of_point.begin(), std::cref(nearest));
}

}  // namespace

std::string_view description_of(RowSource source) noexcept {
  switch (source) {
    case RowSource::kLaserNumbers:
      return "the field of the laser's number";
    case RowSource::kOrganisation:
      return "the rows of the organised cloud";
    case RowSource::kKittiOrder:
      return "the order of the points";
    case RowSource::kElevations:
      return "the elevations of the points";
    case RowSource::kElevationBins:
      return "bins of elevation";
  }
  return "";
}

Expected<NumberedLasers> fit_numbered_lasers(std::size_t lasers, std::size_t clouds,
                                             const ReadCloud& name_lasers) {
  // The largest spread around a laser's cone. Noise and motion cause far less; a map's frame or
  // wrong laser numbers cause far more.
  constexpr double kWidestCone_m = 1.0;
  LaserElevations elevations(lasers);
  const Status looked = for_some(clouds, name_lasers, [&](const CloudView& cloud) -> Status {
    elevations.add(cloud.points, cloud.laser);
    return {};
  });
  if (!looked) return tl::unexpected(looked.error());
  NumberedLasers found{elevations.order(), {}};

  RingTableFit fit(static_cast<int>(lasers));
  std::vector<std::int16_t> ring_of_point;
  const Status read = for_some(clouds, name_lasers, [&](const CloudView& cloud) -> Status {
    find_by_number(cloud.points, cloud.laser, found.ring_of_laser, ring_of_point);
    fit.add(cloud.points, ring_of_point);
    return {};
  });
  if (!read) return tl::unexpected(read.error());
  auto fitted = simplest_fit(fit, lasers);
  if (!fitted) return tl::unexpected(fitted.error());
  if (Status apart = check_apart(*fitted); !apart) return tl::unexpected(apart.error());
  if (fitted->residual.p95_m > kWidestCone_m) {
    return fail(ErrorCode::kMalformed,
                fmt::format("the points of a laser do not lie on a cone around the origin (5 % of "
                            "them are off by more than {:.1f} m): expected are points in the "
                            "sensor's own frame, not in a map's or the vehicle's, of one sensor "
                            "and one revolution a file, and the laser of each",
                            fitted->residual.p95_m));
  }
  found.rings = *std::move(fitted);
  return found;
}

Expected<SensorRows> learn_rows(std::size_t clouds, const ReadCloud& read_any) {
  const ReadCloud read = [&](std::size_t index) -> Expected<CloudView> {
    auto cloud = read_any(index);
    if (!cloud) return cloud;
    if (Status near = check_reach(cloud->points); !near) return tl::unexpected(near.error());
    if (!has_places(cloud->points)) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("none of the {} points is finite, not null and within 10 km",
                              cloud->points.size()));
    }
    if (cloud->laser.empty() || cloud->laser.size() == cloud->points.size()) return cloud;
    return fail(ErrorCode::kMalformed, fmt::format("{} points, but {} numbers of lasers",
                                                   cloud->points.size(), cloud->laser.size()));
  };
  // The first cloud that can be read decides where all clouds take their lasers from.
  std::size_t first = 0;
  Expected<CloudView> cloud = read(first);
  while (!cloud && first + 1 < clouds) cloud = read(++first);
  if (!cloud) return tl::unexpected(cloud.error());

  const bool has_numbers = !cloud->laser.empty(), is_organised = cloud->is_organised();
  const std::size_t rows_or_columns = is_organised ? OrganisedLasers(*cloud).lasers() : 0;
  const std::string note(cloud->laser_note);
  const auto learn_without_numbers = [&](const std::string& no_number) {
    return is_organised ? learn_by_number(RowSource::kOrganisation, rows_or_columns, clouds, read)
                        : learn_from_places(first, clouds, read, no_number);
  };
  Expected<SensorRows> rows = SensorRows{};
  if (has_numbers) {
    std::vector<bool> numbers;  // the numbers in use
    const Status looked = for_some(clouds, read, [&](const CloudView& some) -> Status {
      add_numbers(some, numbers);
      return {};
    });
    if (!looked) return tl::unexpected(looked.error());
    rows = learn_by_number(RowSource::kLaserNumbers, numbers.size(), clouds, read);
    const auto different = std::ranges::count(numbers, true);
    if (!rows && different < kFewestLasers) {  // maybe a field that the driver left empty
      rows = learn_without_numbers(fmt::format("{} has only {} different number{}",
                                               note.empty() ? "the laser of a point" : note,
                                               different, different == 1 ? "" : "s"));
    }
  } else {
    rows = learn_without_numbers("no field with its number" +
                                 (note.empty() ? "" : fmt::format(" ({})", note)));
  }
  if (!rows) return rows;

  const RowFinder finder(*rows);
  AzimuthStep step;
  RingRecovery found;
  const Status looked = for_some(clouds, read, [&](const CloudView& some) -> Status {
    Status status = finder.find(some, found);
    if (status) step.add(some.points, found.ring_of_point);
    return status;
  });
  if (!looked) return tl::unexpected(looked.error());
  rows->columns = step.columns();
  return rows;
}

RowFinder::RowFinder(SensorRows rows) : rows_(std::move(rows)) {
  const bool by_place =
      rows_.source == RowSource::kElevations || rows_.source == RowSource::kElevationBins;
  if (!by_place) return;
  RingTable seen_from_origin = rows_.rings.table;
  for (scan::RingLine& ring : seen_from_origin) ring.vert_offset_m += rows_.viewpoint_above_m;
  nearest_.emplace(seen_from_origin);
}

Status RowFinder::find(const CloudView& cloud, RingRecovery& found) const {
  const bool is_blind = !has_places(cloud.points);
  if (rows_.source == RowSource::kKittiOrder && !is_blind) {
    return scan::recover_rings(cloud.points, &rows_.rings.table, found);
  }
  found.aligned = false;
  found.rings = static_cast<int>(rows_.rings.table.size());
  if (is_blind) {
    found.ring_of_point.assign(cloud.points.size(), kNoRing);
    found.no_ring = cloud.points.size();
    return {};
  }
  switch (rows_.source) {
    case RowSource::kLaserNumbers:
      if (cloud.laser.size() != cloud.points.size()) {
        return fail(ErrorCode::kMalformed,
                    fmt::format("{} points, but {} numbers of lasers; the first cloud had one a "
                                "point",
                                cloud.points.size(), cloud.laser.size()));
      }
      find_by_number(cloud.points, cloud.laser, rows_.ring_of_laser, found.ring_of_point);
      break;
    case RowSource::kOrganisation: {
      const std::size_t lasers = rows_.ring_of_laser.size();
      if (!cloud.is_organised() || OrganisedLasers(cloud).lasers() != lasers) {
        return fail(ErrorCode::kMalformed,
                    fmt::format("{} points in {} rows; the first cloud was organised, of {} lasers",
                                cloud.points.size(), cloud.rows, lasers));
      }
      const OrganisedLasers organised(cloud);
      found.ring_of_point.resize(cloud.points.size());
      for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        found.ring_of_point[i] =
            scan::is_place(cloud.points[i]) ? rows_.ring_of_laser[organised.of(i)] : kNoRing;
      }
      break;
    }
    case RowSource::kElevations:
    case RowSource::kElevationBins:
      find_by_place(*nearest_, cloud.points, found.ring_of_point);
      break;
    case RowSource::kKittiOrder:
      break;
  }
  found.no_ring = static_cast<std::size_t>(std::ranges::count(found.ring_of_point, kNoRing));
  return {};
}

}  // namespace terracut::cloud
