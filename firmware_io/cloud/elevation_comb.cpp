// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/elevation_comb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calib/beams/angle.hpp"
#include "firmware_io/cloud/cloud.hpp"

namespace terracut::cloud {
namespace {

/// Nearer, a beam's start beside the origin matters; no sensor's lowest beam ends nearer on a road.
constexpr float kNearest_m = 1.0F;
/// A bin with less than this share of the points of the fullest one around it lies in a gap.
constexpr std::uint32_t kGapShare = 50;
/// Of the points, at least so many are in teeth that are narrower than the gap beside them.
constexpr double kLeastInTeeth = 0.95;

/// In the mean: what has fewer is a curve or a drawing, not a revolution.
constexpr std::size_t kFewestPointsARow = 10;

/// Bins next to each other, [begin, end).
struct Tooth {
  std::size_t begin, end;
  std::uint64_t points = 0;
  double mean_bin = 0;
};

}  // namespace

void ElevationComb::add(std::span<const scan::ScanPoint> points) {
  for (const scan::ScanPoint& p : points) {
    const float distance_m = std::hypot(p.x_m, p.y_m);
    if (!scan::is_place(p) || !(distance_m > kNearest_m)) continue;
    const double elevation_deg = beams::rad_to_deg(std::atan2(double{p.z_m}, double{distance_m}));
    const auto bin = static_cast<std::size_t>((elevation_deg + 90) * kBinsPerDegree);
    ++points_at_[std::min(bin, kBins - 1)];
    ++points_;
  }
}

Expected<std::vector<double>> ElevationComb::elevations_rad() const {
  const auto fullest_around = [&](std::size_t bin) {
    constexpr std::size_t kAround = kBinsPerDegree / 2;
    const auto first =
        points_at_.begin() + static_cast<std::ptrdiff_t>(bin - std::min(bin, kAround));
    const auto last =
        points_at_.begin() + static_cast<std::ptrdiff_t>(std::min(bin + kAround + 1, kBins));
    return *std::max_element(first, last);
  };
  std::vector<Tooth> teeth;
  bool in_tooth = false;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const std::uint32_t here = points_at_[bin];
    const bool in_gap = here == 0 || here * kGapShare < fullest_around(bin);
    if (!in_gap && !in_tooth) teeth.push_back({bin, bin});
    in_tooth = !in_gap;
    if (!in_tooth) continue;
    Tooth& tooth = teeth.back();
    tooth.end = bin + 1;
    tooth.points += here;
    tooth.mean_bin += (static_cast<double>(bin) + 0.5) * here;
  }
  std::uint64_t in_teeth = 0;
  for (std::size_t i = 0; i < teeth.size(); ++i) {
    const std::size_t below = i == 0 ? kBins : teeth[i].begin - teeth[i - 1].end;
    const std::size_t above = i + 1 == teeth.size() ? kBins : teeth[i + 1].begin - teeth[i].end;
    if (teeth[i].end - teeth[i].begin <= std::min(below, above)) in_teeth += teeth[i].points;
  }
  const double share =
      static_cast<double>(in_teeth) / static_cast<double>(std::max<std::size_t>(points_, 1));
  const bool is_comb = teeth.size() >= kFewestLasers && teeth.size() <= kMostLasers &&
                       share >= kLeastInTeeth && points_ >= kFewestPointsARow * teeth.size();
  if (!is_comb) {
    return fail(
        ErrorCode::kUnsupported,
        fmt::format("the elevations of the {} points form {} rows, and {:.0f} % of the points "
                    "lie in rows with a gap beside them; expected {} to {} rows of {} points or "
                    "more, and {:.0f} %",
                    points_, teeth.size(), 100 * share, kFewestLasers, kMostLasers,
                    kFewestPointsARow, 100 * kLeastInTeeth));
  }
  std::vector<double> elevations;
  for (auto tooth = teeth.rbegin(); tooth != teeth.rend(); ++tooth) {
    const double bin = tooth->mean_bin / static_cast<double>(tooth->points);
    elevations.push_back(beams::deg_to_rad(bin / kBinsPerDegree - 90));
  }
  return elevations;
}

}  // namespace terracut::cloud
