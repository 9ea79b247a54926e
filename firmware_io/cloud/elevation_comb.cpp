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

/// Points nearer than this are left out: at such distances the beam's start beside the origin
/// changes the elevation too much. No vehicle's lowest beam meets the road nearer than this.
constexpr float kNearestUsed_m = 1.0F;
/// A bin lies in a gap if the fullest bin around it has more than this many times its points.
constexpr std::uint32_t kGapShare = 50;
/// The least share of the points that must lie in teeth narrower than the gaps beside them.
constexpr double kLeastInTeeth = 0.95;

/// If rows have fewer points than this on average, the cloud is a curve or a drawing, not a
/// revolution.
constexpr std::size_t kFewestPointsARow = 10;

}  // namespace

void ElevationComb::add(std::span<const scan::ScanPoint> points) {
  for (const scan::ScanPoint& p : points) {
    if (!scan::is_place(p)) continue;
    const float distance_m = std::hypot(p.x_m, p.y_m);
    const double elevation_deg = beams::rad_to_deg(std::atan2(double{p.z_m}, double{distance_m}));
    const auto bin = static_cast<std::size_t>((elevation_deg + 90) * kBinsPerDegree);
    all_.add(std::min(bin, kBins - 1));
    if (distance_m > kNearestUsed_m) far_.add(std::min(bin, kBins - 1));
  }
}

ElevationComb::Comb ElevationComb::comb_of(const Histogram& histogram) {
  const auto& points_at = histogram.points_at;
  const auto fullest_around = [&](std::size_t bin) {
    constexpr std::size_t kAround = kBinsPerDegree / 2;
    const auto first =
        points_at.begin() + static_cast<std::ptrdiff_t>(bin - std::min(bin, kAround));
    const auto last =
        points_at.begin() + static_cast<std::ptrdiff_t>(std::min(bin + kAround + 1, kBins));
    return *std::max_element(first, last);
  };
  Comb comb;
  bool in_tooth = false;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const std::uint32_t here = points_at[bin];
    const bool in_gap = here == 0 || here * kGapShare < fullest_around(bin);
    if (!in_gap && !in_tooth) comb.teeth.push_back({bin, bin});
    in_tooth = !in_gap;
    if (!in_tooth) continue;
    Tooth& tooth = comb.teeth.back();
    tooth.end = bin + 1;
    tooth.points += here;
    tooth.mean_bin += (static_cast<double>(bin) + 0.5) * here;
  }
  std::vector<Tooth>& teeth = comb.teeth;
  std::uint64_t in_teeth = 0;
  for (std::size_t i = 0; i < teeth.size(); ++i) {
    const std::size_t below = i == 0 ? kBins : teeth[i].begin - teeth[i - 1].end;
    const std::size_t above = i + 1 == teeth.size() ? kBins : teeth[i + 1].begin - teeth[i].end;
    teeth[i].is_narrow = teeth[i].bins() <= std::min(below, above);
    if (teeth[i].is_narrow) in_teeth += teeth[i].points;
  }
  comb.share_in_teeth = static_cast<double>(in_teeth) /
                        static_cast<double>(std::max<std::size_t>(histogram.points, 1));
  comb.is_comb = teeth.size() >= kFewestLasers && teeth.size() <= kMostLasers &&
                 comb.share_in_teeth >= kLeastInTeeth &&
                 histogram.points >= kFewestPointsARow * teeth.size();
  return comb;
}

/// Returns the teeth of `all` at elevations where `far` has none. The near points of a laser whose
/// beam starts beside the origin spread around its elevation, so a tooth counts only if it is as
/// narrow as the far ones.
std::vector<ElevationComb::Tooth> ElevationComb::rows_seen_nearby(const Comb& all,
                                                                  const std::vector<Tooth>& far) {
  std::vector<Tooth> nearby;
  if (!all.is_comb) return nearby;
  const std::size_t widest = std::ranges::max(far, {}, &Tooth::bins).bins();
  for (const Tooth& tooth : all.teeth) {
    const bool is_known = std::ranges::any_of(far, [&](const Tooth& known) {
      return known.begin <= tooth.end && tooth.begin <= known.end;
    });
    const bool is_row =
        tooth.is_narrow && tooth.bins() <= widest && tooth.points >= kFewestPointsARow;
    if (!is_known && is_row) nearby.push_back(tooth);
  }
  if (far.size() + nearby.size() > kMostLasers) nearby.clear();
  return nearby;
}

Expected<std::vector<double>> ElevationComb::elevations_rad() const {
  Comb comb = comb_of(far_);
  if (!comb.is_comb) {
    return fail(
        ErrorCode::kUnsupported,
        fmt::format("the elevations of the {} points form {} rows, and {:.0f} % of the points "
                    "lie in rows with a gap beside them; expected {} to {} rows of {} points or "
                    "more, and {:.0f} %",
                    far_.points, comb.teeth.size(), 100 * comb.share_in_teeth, kFewestLasers,
                    kMostLasers, kFewestPointsARow, 100 * kLeastInTeeth));
  }
  const std::vector<Tooth> nearby = rows_seen_nearby(comb_of(all_), comb.teeth);
  comb.teeth.insert(comb.teeth.end(), nearby.begin(), nearby.end());
  std::ranges::sort(comb.teeth, {}, &Tooth::begin);
  std::vector<double> elevations;
  for (auto tooth = comb.teeth.rbegin(); tooth != comb.teeth.rend(); ++tooth) {
    const double bin = tooth->mean_bin / static_cast<double>(tooth->points);
    elevations.push_back(beams::deg_to_rad(bin / kBinsPerDegree - 90));
  }
  return elevations;
}

}  // namespace terracut::cloud
