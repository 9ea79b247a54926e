// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scan_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "calib/beams/angle.hpp"
#include "tools/lab/quality/quality.hpp"

namespace terracut::encode {
namespace {

constexpr double kRevolution_rad = 2 * std::numbers::pi;
constexpr int kBins = 3600;
constexpr double kBin_rad = kRevolution_rad / kBins;

// The HDL-64E of the recordings fires every 0.17 to 0.18 degrees, its rings are 0.33 to 0.55 apart.
constexpr double kJoined_rad = beams::deg_to_rad(0.30);    // successive returns of a ring
constexpr double kBeside_rad = beams::deg_to_rad(0.12);    // a return stands for its ring
constexpr double kNextRing_rad = beams::deg_to_rad(1.20);  // neighbouring rings; blocks part by 0.9
constexpr double kAboveBelow_rad = beams::deg_to_rad(0.28);  // a ring stands for its direction
/// The line through two returns must not run along the ray: flatter than this, it is a leap from
/// one surface to another. Level ground is seen at 1.5 degrees at 66 m.
const double kLeastSlope = std::tan(beams::deg_to_rad(1.5));

double in_frame(double azimuth_rad) {
  const double rest = azimuth_rad - kRevolution_rad * std::floor(azimuth_rad / kRevolution_rad);
  return rest < kRevolution_rad ? rest : 0.0;
}

/// From `a` forward to `b`, both in a frame.
double forward(double a, double b) {
  return b >= a ? b - a : b - a + kRevolution_rad;
}

bool same_thing(std::uint32_t a, std::uint32_t b) {
  if (a == b) return true;
  return quality::truth_class(a) == quality::TruthClass::kGround &&
         quality::truth_class(b) == quality::TruthClass::kGround;
}

template <class Place>
bool one_surface(const Place& a, const Place& b, double apart_rad) {
  if (!same_thing(a.label, b.label)) return false;
  const double near_m = std::min(a.range_m, b.range_m), far_m = std::max(a.range_m, b.range_m);
  const double along_m = far_m - near_m * std::cos(apart_rad);
  return near_m * std::sin(apart_rad) >= kLeastSlope * along_m;
}

/// On the straight line between two places, at this share of the angle between them.
double range_between_m(double from_m, double to_m, double share) {
  return 1.0 / ((1.0 - share) / from_m + share / to_m);
}

}  // namespace

ScanSurface::ScanSurface() : columns_(kBins) {
  for (Ring& ring : rings_) ring.begin.resize(kBins);
}

void ScanSurface::take(std::span<const scan::ScanPoint> points,
                       std::span<const std::int16_t> ring_of_point,
                       std::span<const std::uint32_t> labels) {
  for (Ring& ring : rings_) ring.spots.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (ring_of_point[i] == scan::kNoRing || !scan::is_place(points[i])) continue;
    const double x = points[i].x_m, y = points[i].y_m, z = points[i].z_m;
    const double range_m = std::sqrt(x * x + y * y + z * z);
    if (range_m <= 0) continue;
    rings_[static_cast<std::size_t>(ring_of_point[i])].spots.push_back(
        {scan::azimuth_rad(x, y), std::asin(z / range_m), range_m, labels.empty() ? 0 : labels[i],
         static_cast<std::uint32_t>(i)});
  }
  for (Ring& ring : rings_) index(ring);
  list_candidates();
  measure_span();
}

void ScanSurface::index(Ring& ring) const {
  std::ranges::sort(ring.spots, {},
                    [](const Spot& spot) { return std::pair(spot.azimuth_rad, spot.point); });
  std::uint32_t next = 0;
  for (std::size_t bin = 0; bin < ring.begin.size(); ++bin) {
    const double from_rad = static_cast<double>(bin) * kBin_rad;
    while (next < ring.spots.size() && ring.spots[next].azimuth_rad < from_rad) ++next;
    ring.begin[bin] = next;
  }
}

void ScanSurface::list_candidates() {
  for (std::size_t bin = 0; bin < columns_.size(); ++bin) {
    std::vector<Candidate>& column = columns_[bin];
    column.clear();
    const double middle_rad = (static_cast<double>(bin) + 0.5) * kBin_rad;
    for (int ring = 0; ring < scan::kScanRings; ++ring) {
      const auto crossing = cross(ring, middle_rad);
      if (!crossing) continue;
      column.push_back({static_cast<float>(crossing->elevation_rad), crossing->ring});
    }
    std::ranges::sort(column, {}, [](const Candidate& candidate) {
      return std::pair(candidate.elevation_rad, candidate.ring);
    });
  }
}

void ScanSurface::measure_span() {
  highest_rad_ = -std::numbers::pi;
  lowest_rad_ = std::numbers::pi;
  for (const Ring& ring : rings_) {
    if (ring.spots.empty()) continue;
    double sum_rad = 0;
    for (const Spot& spot : ring.spots) sum_rad += spot.elevation_rad;
    const double mean_rad = sum_rad / static_cast<double>(ring.spots.size());
    highest_rad_ = std::max(highest_rad_, mean_rad);
    lowest_rad_ = std::min(lowest_rad_, mean_rad);
  }
}

bool ScanSurface::covers(double elevation_rad) const noexcept {
  return elevation_rad <= highest_rad_ + kAboveBelow_rad &&
         elevation_rad >= lowest_rad_ - kAboveBelow_rad;
}

auto ScanSurface::cross(int ring, double azimuth_rad) const -> std::optional<Crossing> {
  const Ring& r = rings_[static_cast<std::size_t>(ring)];
  if (r.spots.empty()) return std::nullopt;
  const auto bin = std::min(static_cast<std::size_t>(azimuth_rad / kBin_rad), r.begin.size() - 1);
  std::size_t after = r.begin[bin];
  while (after < r.spots.size() && r.spots[after].azimuth_rad < azimuth_rad) ++after;
  const Spot& a = r.spots[after == 0 ? r.spots.size() - 1 : after - 1];
  const Spot& b = r.spots[after == r.spots.size() ? 0 : after];
  const double from_a = forward(a.azimuth_rad, azimuth_rad);
  const double to_b = forward(azimuth_rad, b.azimuth_rad);
  const Spot& nearer = from_a <= to_b ? a : b;
  Crossing crossing{nearer.elevation_rad, nearer.range_m, nearer.label, nearer.point,
                    static_cast<std::int16_t>(ring)};
  const double apart_rad = from_a + to_b;
  if (apart_rad > 0 && apart_rad <= kJoined_rad && one_surface(a, b, apart_rad)) {
    const double share = from_a / apart_rad;
    crossing.range_m = range_between_m(a.range_m, b.range_m, share);
    crossing.elevation_rad = (1 - share) * a.elevation_rad + share * b.elevation_rad;
    return crossing;
  }
  if (std::min(from_a, to_b) > kBeside_rad) return std::nullopt;
  return crossing;
}

auto ScanSurface::look(double azimuth_rad, double elevation_rad) const -> std::optional<Sight> {
  const double azimuth = in_frame(azimuth_rad);
  const auto bin = std::min(static_cast<std::size_t>(azimuth / kBin_rad), columns_.size() - 1);
  const std::vector<Candidate>& column = columns_[bin];
  const auto above_at = std::ranges::lower_bound(column, static_cast<float>(elevation_rad), {},
                                                 &Candidate::elevation_rad);
  std::optional<Crossing> above, below;
  if (above_at != column.end()) above = cross(above_at->ring, azimuth);
  if (above_at != column.begin()) below = cross(std::prev(above_at)->ring, azimuth);

  if (above && below && std::abs(above->ring - below->ring) == 1) {
    const double apart_rad = above->elevation_rad - below->elevation_rad;
    const double share = (elevation_rad - below->elevation_rad) / apart_rad;
    if (apart_rad > 0 && apart_rad <= kNextRing_rad && share >= 0 && share <= 1 &&
        one_surface(*above, *below, apart_rad)) {
      return Sight{range_between_m(below->range_m, above->range_m, share),
                   share < 0.5 ? below->point : above->point};
    }
  }
  const auto off_rad = [&](const std::optional<Crossing>& crossing) {
    return crossing ? std::abs(crossing->elevation_rad - elevation_rad) : kRevolution_rad;
  };
  const std::optional<Crossing>& nearer = off_rad(below) <= off_rad(above) ? below : above;
  if (off_rad(nearer) > kAboveBelow_rad) return std::nullopt;
  return Sight{nearer->range_m, nearer->point};
}

}  // namespace terracut::encode
