// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/ring_table_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "calib/beams/angle.hpp"
#include "firmware_io/scan/line_fit.hpp"

namespace terracut::scan {
namespace {

// How far motion-compensated points scatter about the true line: in horizontal distance (the motion
// in half a revolution at some 10 m/s), and in height (a laser's noise). Only the ratio of the two
// matters, and only for rings steeper than a few degrees. The values were not tuned.
constexpr double kDistanceError_m = 0.2;
constexpr double kHeightError_m = 0.01;

constexpr double kMinStep_rad = beams::deg_to_rad(0.02);  // rings never cross or coincide

HeightResidual summarise(std::vector<double>& sizes) {
  HeightResidual residual;
  residual.points = sizes.size();
  if (sizes.empty()) return residual;
  double squares = 0;
  for (const double r : sizes) squares += r * r;
  residual.rms_m = std::sqrt(squares / static_cast<double>(sizes.size()));
  const auto p95 = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 95 / 100);
  std::nth_element(sizes.begin(), p95, sizes.end());
  residual.p95_m = *p95;
  const auto median = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), median, sizes.end());
  residual.median_m = *median;
  return residual;
}

/// The steepest ring that is extrapolated; a whole table of the smallest steps ends below 90
/// degrees.
constexpr double kSteepest_rad = beams::deg_to_rad(80.0);

/// Interpolates rings without a fit between fitted ones, and extrapolates those beyond.
void fill_gaps(std::vector<std::optional<RingLine>>& lines) {
  const int rings = static_cast<int>(lines.size());
  for (int ring = 0; ring < rings; ++ring) {
    if (lines[static_cast<std::size_t>(ring)]) continue;
    int above = ring, below = ring;
    while (above >= 0 && !lines[static_cast<std::size_t>(above)]) --above;
    while (below < rings && !lines[static_cast<std::size_t>(below)]) ++below;
    const bool is_beyond = above < 0 || below >= rings;
    if (is_beyond) {  // beyond the last fitted ring: continue at its pitch
      const int step = above < 0 ? 1 : -1;
      int near = ring, far;
      while (!lines[static_cast<std::size_t>(near)]) near += step;
      far = near + step;
      while (!lines[static_cast<std::size_t>(far)]) far += step;
      above = near;
      below = far;
    }
    const RingLine a = *lines[static_cast<std::size_t>(above)];
    const RingLine b = *lines[static_cast<std::size_t>(below)];
    const double share = static_cast<double>(ring - above) / (below - above);
    // If noise has exchanged the last two rings, the smallest step is used.
    const double fall_rad = (a.elevation_rad - b.elevation_rad) * (below > above ? 1 : -1);
    const double apart_rad = std::max(fall_rad, kMinStep_rad) * (below > above ? -1 : 1);
    double elevation_rad = a.elevation_rad + share * apart_rad;
    if (is_beyond) elevation_rad = std::clamp(elevation_rad, -kSteepest_rad, kSteepest_rad);
    lines[static_cast<std::size_t>(ring)] = RingLine{elevation_rad, a.vert_offset_m};
  }
}

}  // namespace

void RingTableFit::add(std::span<const ScanPoint> points,
                       std::span<const std::int16_t> ring_of_point) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float distance_m = std::hypot(points[i].x_m, points[i].y_m);
    if (ring_of_point[i] == kNoRing || !(std::hypot(distance_m, points[i].z_m) < kReach_m))
      continue;
    Ring& ring = rings_[static_cast<std::size_t>(ring_of_point[i])];
    if (ring.seen++ % ring.stride != 0) continue;
    // Keeps every other sample, and samples half as often from now on.
    if (ring.samples.size() == kPointsPerRing) {
      std::size_t kept = 0;
      for (std::size_t from = 0; from < ring.samples.size(); from += 2) {
        ring.samples[kept++] = ring.samples[from];
      }
      ring.samples.resize(kept);
      ring.stride *= 2;
    }
    ring.samples.push_back({distance_m, points[i].z_m});
  }
}

HeightResidual RingTableFit::residual(const RingLine& line, const Ring& ring,
                                      std::vector<double>& all) {
  const double slope = std::tan(line.elevation_rad);
  std::vector<double> sizes;
  sizes.reserve(ring.samples.size());
  for (const Sample& s : ring.samples) {
    sizes.push_back(std::abs(s.z_m - line.vert_offset_m - slope * s.distance_m));
  }
  all.insert(all.end(), sizes.begin(), sizes.end());
  return summarise(sizes);
}

RingLine RingTableFit::through(const Ring& ring, double vert_offset_m) {
  std::vector<double> slopes;
  for (const Sample& s : ring.samples) {
    slopes.push_back((s.z_m - vert_offset_m) / (double{s.distance_m} + 1e-3));
  }
  const auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
  std::nth_element(slopes.begin(), middle, slopes.end());
  return {std::atan(*middle), vert_offset_m};
}

Expected<FittedRings> RingTableFit::fit(const RingTable* offsets) const {
  Lines lines(rings_.size());
  std::vector<LinePoint> points;
  for (std::size_t ring = 0; ring < lines.size(); ++ring) {
    if (rings_[ring].samples.size() < kMinPointsPerRing) continue;
    if (offsets != nullptr) {
      lines[ring] = through(rings_[ring], (*offsets)[ring].vert_offset_m);
      continue;
    }
    points.clear();
    for (const Sample& s : rings_[ring].samples) points.push_back({s.distance_m, s.z_m});
    const FittedLine line = fit_line(points, kHeightError_m / kDistanceError_m);
    if (std::isfinite(line.slope)) lines[ring] = RingLine{std::atan(line.slope), line.offset};
  }
  const auto found = static_cast<std::size_t>(
      std::count_if(lines.begin(), lines.end(), [](const auto& l) { return !!l; }));
  if (found < lines.size() / 2) {
    return fail(
        ErrorCode::kMalformed,
        fmt::format("only {} of {} rings have the {} points a fit needs; add more scans, or "
                    "give the unit's calibration",
                    found, lines.size(), kMinPointsPerRing));
  }
  return table_of(std::move(lines));
}

Expected<FittedRings> RingTableFit::fit_seen(const RingTable& offsets) const {
  constexpr std::size_t kFewestRings = 4;
  Lines lines(rings_.size());
  std::size_t found = 0, points_of_found = 0, points = 0;
  for (std::size_t ring = 0; ring < lines.size(); ++ring) {
    points += rings_[ring].seen;
    if (rings_[ring].samples.size() < kMinPointsPerSeenRing) continue;
    lines[ring] = through(rings_[ring], offsets[ring].vert_offset_m);
    points_of_found += rings_[ring].seen;
    ++found;
  }
  if (found < kFewestRings || 2 * points_of_found < points) {
    return fail(ErrorCode::kMalformed,
                fmt::format("only {} of {} rings have the {} points that tell where a laser looks; "
                            "give whole revolutions, or more of them",
                            found, lines.size(), kMinPointsPerSeenRing));
  }
  return table_of(std::move(lines));
}

FittedRings RingTableFit::table_of(Lines lines) const {
  std::vector<bool> has_line;
  for (const auto& line : lines) has_line.push_back(line.has_value());
  fill_gaps(lines);

  FittedRings fitted;
  std::vector<double> all;
  for (std::size_t ring = 0; ring < lines.size(); ++ring) {
    RingLine line = *lines[ring];
    fitted.with_line += has_line[ring] ? 1U : 0U;
    if (ring > 0) {
      const double highest_rad = fitted.table[ring - 1].elevation_rad - kMinStep_rad;
      fitted.coinciding += has_line[ring] && line.elevation_rad > highest_rad ? 1U : 0U;
      line.elevation_rad = std::min(line.elevation_rad, highest_rad);
    }
    fitted.table.push_back(line);
    fitted.by_ring.push_back(residual(line, rings_[ring], all));
  }
  fitted.residual = summarise(all);
  return fitted;
}

}  // namespace terracut::scan
