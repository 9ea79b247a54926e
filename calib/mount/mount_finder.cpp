// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calib/beams/angle.hpp"
#include "calib/mount/mount_estimate.hpp"

namespace terracut::mount {
namespace {

constexpr std::array kFigures{&Mount::height_m, &Mount::roll_rad, &Mount::pitch_rad};

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values[values.size() / 2] + values[(values.size() - 1) / 2]) / 2;
}

/// Returns the standard deviation estimated from the median absolute deviation, which outliers
/// hardly affect.
double spread_of(std::span<const Mount> mounts, double Mount::* figure, double middle) {
  constexpr double kOfNormal = 1.4826;
  std::vector<double> distances;
  for (const Mount& mount : mounts) distances.push_back(std::abs(mount.*figure - middle));
  return kOfNormal * median_of(std::move(distances));
}

double rounded_rad(double angle_rad) {
  return beams::deg_to_rad(std::round(beams::rad_to_deg(angle_rad) * 100) / 100);
}

}  // namespace

Mount median_of(std::span<const Mount> mounts) {
  Mount median;
  for (const auto figure : kFigures) {
    std::vector<double> values;
    for (const Mount& mount : mounts) values.push_back(mount.*figure);
    median.*figure = median_of(std::move(values));
  }
  return median;
}

bool FoundMount::is_certain() const noexcept {
  const double tilt_rad = std::max(uncertainty.roll_rad, uncertainty.pitch_rad);
  return uncertainty.height_m <= 0.15 && tilt_rad <= beams::deg_to_rad(2.5);
}

std::string to_string(const FoundMount& found) {
  const auto figure = [](const std::string& value, double uncertainty, int decimals) {
    return uncertainty > 0 ? fmt::format("{} (+-{:.{}f})", value, uncertainty, decimals)
                           : value + " (stated)";
  };
  const auto angle = [&](const char* name, double Mount::* of) {
    return figure(fmt::format("{} {:.2f} deg", name, beams::rad_to_deg(found.mount.*of)),
                  beams::rad_to_deg(found.uncertainty.*of), 1);
  };
  return fmt::format(
      "{}, {}, {}, found in {} {}",
      figure(fmt::format("height {:.3f} m", found.mount.height_m), found.uncertainty.height_m, 3),
      angle("roll", &Mount::roll_rad), angle("pitch", &Mount::pitch_rad), found.frames,
      found.frames == 1 ? "frame" : "frames");
}

Error uncertain(const FoundMount& found) {
  return {ErrorCode::kMountNotFound,
          "so little of the ground is seen that it is uncertain: " + to_string(found)};
}

bool MountFinder::add_frame(std::span<const std::array<float, 3>> points) {
  return add_estimate(estimate_mount(points));
}

bool MountFinder::add_estimate(const Expected<MountEstimate>& estimated) {
  ++looked_at_;
  if (!estimated) {
    last_fault_ = estimated.error().message;
    return false;
  }
  seen_.push_back(estimated->mount);
  // Rolls of 179 and -179 degrees (upside down) are nearly the same, so take the nearer equivalent.
  seen_.back().roll_rad = nearest_turn(estimated->mount.roll_rad, seen_.front().roll_rad);
  deviations_.push_back(estimated->deviation);
  return true;
}

Expected<FoundMount> MountFinder::found() const {
  if (2 * seen_.size() < looked_at_ || seen_.empty()) {
    return fail(ErrorCode::kMountNotFound, fmt::format("of {} frames {} show a ground; {}",
                                                       looked_at_, seen_.size(), last_fault_));
  }
  const Mount middle = median_of(std::span(seen_)), deviation = median_of(std::span(deviations_));
  FoundMount found{{std::round(middle.height_m * 1000) / 1000,
                    rounded_rad(nearest_turn(middle.roll_rad, 0)), rounded_rad(middle.pitch_rad)},
                   {},
                   seen_.size()};
  for (const auto figure : kFigures) {
    found.uncertainty.*figure =
        2 * std::hypot(deviation.*figure, spread_of(seen_, figure, middle.*figure));
  }
  return found;
}

Expected<FoundMount> MountFinder::certain() const {
  auto seen = found();
  if (seen && !seen->is_certain()) return tl::unexpected(uncertain(*seen));
  return seen;
}

}  // namespace terracut::mount
