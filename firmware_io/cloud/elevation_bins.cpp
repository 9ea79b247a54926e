// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/elevation_bins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "calib/beams/angle.hpp"
#include "firmware_io/cloud/row_doubt.hpp"
#include "firmware_io/scan/ring_fit_of_scans.hpp"

namespace terracut::cloud {
namespace {

using beams::deg_to_rad;
using beams::rad_to_deg;

constexpr std::size_t kFewestPoints = 1000;

/// Measures the solid angle in which a cloud has points, by cells of two degrees.
class ViewedAngle {
 public:
  void add(double azimuth_rad, double elevation_rad) {
    const int row =
        std::clamp(static_cast<int>((rad_to_deg(elevation_rad) + 90) / kCell_deg), 0, kRows - 1);
    const int column =
        std::clamp(static_cast<int>((rad_to_deg(azimuth_rad) + 180) / kCell_deg), 0, kColumns - 1);
    auto&& seen = seen_[static_cast<std::size_t>(row * kColumns + column)];
    if (seen) return;
    seen = true;
    const double cell_rad = deg_to_rad(kCell_deg);
    sum_sr_ += cell_rad * cell_rad * std::cos(deg_to_rad((row + 0.5) * kCell_deg - 90));
  }
  [[nodiscard]] double sum_sr() const noexcept { return sum_sr_; }

 private:
  static constexpr double kCell_deg = 2;
  static constexpr int kRows = 90, kColumns = 180;

  std::vector<bool> seen_ = std::vector<bool>(static_cast<std::size_t>(kRows * kColumns));
  double sum_sr_ = 0;
};

/// Estimates how high the ground is around the origin: the median of the lowest points of the
/// square metres within 10 m.
class GroundAroundOrigin {
 public:
  GroundAroundOrigin() : lowest_m_(static_cast<std::size_t>(kSide * kSide), kNone_m) {}

  void add(const scan::ScanPoint& point) {
    if (std::max(std::abs(point.x_m), std::abs(point.y_m)) >= kReach_m) return;
    const auto cell = [](float m) { return static_cast<int>(m + kReach_m); };
    float& lowest_m =
        lowest_m_[static_cast<std::size_t>(cell(point.x_m) * kSide + cell(point.y_m))];
    lowest_m = std::min(lowest_m, point.z_m);
  }
  /// Returns its height above the origin; a large number if too little is seen of it.
  [[nodiscard]] float height_m() const {
    constexpr std::size_t kFewestCells = 40;
    std::vector<float> seen;
    std::ranges::copy_if(lowest_m_, std::back_inserter(seen),
                         [](float lowest_m) { return lowest_m < kNone_m; });
    if (seen.size() < kFewestCells) return kNone_m;
    const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2);
    std::ranges::nth_element(seen, middle);
    return *middle;
  }

 private:
  static constexpr float kReach_m = 10, kNone_m = 1e9F;
  static constexpr int kSide = 20;

  std::vector<float> lowest_m_;
};

/// Calls `use` with some of the clouds; those without a valid position are left out.
Status for_some_seen(std::size_t clouds, const ReadCloud& read,
                     const std::function<void(const CloudView&)>& use) {
  return scan::read_some_scans(clouds, [&](std::size_t index) -> Status {
    const auto cloud = read(index);
    if (!cloud) return tl::unexpected(cloud.error());
    if (Status near = check_reach(cloud->points); !near) return near;
    if (has_places(cloud->points)) use(*cloud);
    return {};
  });
}

/// Returns from how far above the origin points are seen: from the origin itself where a sensor may
/// be, 0.2 m or more above the ground (mount::MountFinder).
Expected<double> viewpoint_above_m(std::size_t clouds, const ReadCloud& read) {
  constexpr float kLowestSensor_m = 0.2F;
  constexpr double kUsualSensor_m = 1.8;
  GroundAroundOrigin ground;
  const Status looked = for_some_seen(clouds, read, [&](const CloudView& cloud) {
    for (const scan::ScanPoint& point : cloud.points) {
      if (scan::is_place(point)) ground.add(point);
    }
  });
  if (!looked) return tl::unexpected(looked.error());
  const float ground_m = ground.height_m();
  const bool is_on_the_ground = std::abs(ground_m) < kLowestSensor_m;
  return is_on_the_ground ? static_cast<double>(ground_m) + kUsualSensor_m : 0.0;
}

/// What the points of some clouds look like from one place.
struct View {
  std::vector<float> elevations_rad;  ///< Of all points of all clouds, ascending.
  double viewed_sr = 0;               ///< Sum over the clouds.
  std::size_t clouds = 0;

  /// Returns the mean distance between neighbouring points of a cloud.
  [[nodiscard]] double spacing_rad() const noexcept {
    return std::sqrt(viewed_sr / static_cast<double>(elevations_rad.size()));
  }
};

Expected<View> view_from(double above_m, std::size_t clouds, const ReadCloud& read) {
  View view;
  const Status looked = for_some_seen(clouds, read, [&](const CloudView& cloud) {
    ViewedAngle viewed;
    for (const scan::ScanPoint& point : cloud.points) {
      if (!scan::is_place(point)) continue;
      const double elevation_rad =
          std::atan2(static_cast<double>(point.z_m) - above_m,
                     std::hypot(static_cast<double>(point.x_m), static_cast<double>(point.y_m)));
      view.elevations_rad.push_back(static_cast<float>(elevation_rad));
      viewed.add(std::atan2(point.y_m, point.x_m), elevation_rad);
    }
    view.viewed_sr += viewed.sum_sr();
    ++view.clouds;
  });
  if (!looked) return tl::unexpected(looked.error());
  std::ranges::sort(view.elevations_rad);
  return view;
}

}  // namespace

Expected<SensorRows> bin_elevations(std::size_t clouds, const ReadCloud& read) {
  const auto above_m = viewpoint_above_m(clouds, read);
  if (!above_m) return tl::unexpected(above_m.error());
  const auto view = view_from(*above_m, clouds, read);
  if (!view) return tl::unexpected(view.error());
  const std::vector<float>& elevations_rad = view->elevations_rad;
  if (elevations_rad.size() < kFewestPoints * std::max<std::size_t>(view->clouds, 1)) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{} points in {} clouds; expected {} or more in each",
                            elevations_rad.size(), view->clouds, kFewestPoints));
  }
  // One point in a thousand may lie anywhere.
  const std::size_t strays = elevations_rad.size() / 1000;
  const double lowest_rad = elevations_rad[strays];
  const double highest_rad = elevations_rad[elevations_rad.size() - 1 - strays];
  const double spacing_rad = view->spacing_rad();
  const long bins = std::lround((highest_rad - lowest_rad) / spacing_rad);
  if (bins < kFewestLasers) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("all points lie between {:.2f} and {:.2f} degrees of elevation, {:.2f} "
                            "degrees apart in the mean; expected are {} rows or more of them",
                            rad_to_deg(lowest_rad), rad_to_deg(highest_rad),
                            rad_to_deg(spacing_rad), kFewestLasers));
  }
  const int rows = static_cast<int>(std::min<long>(bins, kMostLasers));
  SensorRows binned{.source = RowSource::kElevationBins, .viewpoint_above_m = *above_m};
  for (int row = 0; row < rows; ++row) {
    const double elevation_rad = highest_rad - (highest_rad - lowest_rad) * (row + 0.5) / rows;
    binned.rings.table.push_back({elevation_rad, 0});
  }
  constexpr double kFewestColumns = 360, kMostColumns = 4500;
  binned.columns = static_cast<int>(
      std::lround(std::clamp(2 * std::numbers::pi / spacing_rad, kFewestColumns, kMostColumns)));
  return binned;
}

Expected<SensorRows> rows_or_bins(Expected<SensorRows> rows, std::size_t clouds,
                                  const ReadCloud& read) {
  const std::string doubt = rows ? doubt_of(*rows) : rows.error().message;
  if (doubt.empty()) return rows;
  auto bins = bin_elevations(clouds, read);
  if (!bins) return rows;
  bins->no_lasers = doubt;
  return bins;
}

Expected<SensorRows> learn_rows_or_bins(std::size_t clouds, const ReadCloud& read) {
  return rows_or_bins(learn_rows(clouds, read), clouds, read);
}

}  // namespace terracut::cloud
