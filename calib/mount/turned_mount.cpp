// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/turned_mount.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "calib/beams/angle.hpp"

namespace terracut::mount {
namespace {

using Points = std::vector<std::array<float, 3>>;

/// Step between the rotations tried; estimate_mount() searches 15 degrees around each.
constexpr double kTurn_rad = beams::deg_to_rad(20);
constexpr int kTurns = 3;  ///< Number of rotations to either side of level.

/// Accepted heights. Below 0.5 m, returns of nearly level beams look like ground whatever they hit.
constexpr double kLowestSensor_m = 0.5, kHighestSensor_m = 6.0;
constexpr float kNear_m = 15.0F;  ///< Up to here the ground is taken for a plane.
/// A point this close to the ground, above or below, is on it.
constexpr float kOnGround_m = 0.15F;
/// Least share of the strip's points that must lie on the ground.
constexpr double kLeastOnGround = 0.5;
constexpr float kBelowGround_m = 0.3F;  ///< A point lower than this is below the ground.
/// Largest share of near points that may lie below the ground.
constexpr double kMostBelow = 0.05;
/// A point at least this much higher than the sensor counts as above it.
constexpr float kAboveSensor_m = 0.3F;
constexpr double kFewAbove = 0.02;  ///< A smaller share of returns above the sensor makes no floor.
constexpr double kLevelAbove_m = 0.3;  ///< Half the thickness of a floor above the sensor.
/// Largest share of the returns above the sensor that may lie at one height.
constexpr double kMostLevelAbove = 0.25;

Points turned(std::span<const std::array<float, 3>> points, const Mount& mount) {
  const RigidTransform T = T_vehicle_lidar(mount);
  Points out;
  out.reserve(points.size());
  for (const auto& p : points) {
    const auto [x, y, z] = apply(T, double{p[0]}, double{p[1]}, double{p[2]});
    out.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  }
  return out;
}

Mount without_height(Mount mount) {
  mount.height_m = 0;
  return mount;
}

/// Estimates the mount in the frame rotated by `turn`, then again in the frame that this estimate
/// levels.
Expected<MountEstimate> estimate_about(const Mount& turn,
                                       std::span<const std::array<float, 3>> points) {
  const auto rough = estimate_mount(turned(points, without_height(turn)));
  if (!rough) return rough;
  const Mount level = on_top_of(turn, rough->mount);
  auto seen = estimate_mount(turned(points, without_height(level)));
  if (seen) seen->mount = on_top_of(level, seen->mount);
  return seen;
}

template <class IsIt>
double share_of(const Points& points, IsIt is_it) {
  return static_cast<double>(std::ranges::count_if(points, is_it)) /
         static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

/// True if many returns above the sensor lie at one height, as below a floor or ceiling. The tops
/// of houses and trees along a street differ in height.
bool has_level_above(const Points& around, double height_m) {
  std::vector<float> above_m;
  for (const auto& p : around) {
    if (double{p[2]} > height_m + double{kAboveSensor_m}) above_m.push_back(p[2]);
  }
  if (static_cast<double>(above_m.size()) <= kFewAbove * static_cast<double>(around.size())) {
    return false;
  }
  const auto high = above_m.begin() + static_cast<std::ptrdiff_t>(above_m.size() * 9 / 10);
  std::ranges::nth_element(above_m, high);
  const double top_m = double{*high};
  const auto level = std::ranges::count_if(
      above_m, [&](float z_m) { return std::abs(double{z_m} - top_m) < kLevelAbove_m; });
  return static_cast<double>(level) > kMostLevelAbove * static_cast<double>(above_m.size());
}

/// Returns the reason to reject an estimate; empty if there is none.
std::string doubt_of(const MountEstimate& seen, std::span<const std::array<float, 3>> strip,
                     std::span<const std::array<float, 3>> around) {
  const Mount& mount = seen.mount;
  if (mount.height_m < kLowestSensor_m || mount.height_m > kHighestSensor_m) {
    return fmt::format("one is looked for {:g} to {:g} m away", kLowestSensor_m, kHighestSensor_m);
  }
  const auto above_ground_m = [bend_per_m = static_cast<float>(seen.bend_per_m)](const auto& p) {
    return p[2] - bend_per_m * p[0] * p[0];
  };
  const double on_ground = share_of(turned(strip, mount), [&](const auto& p) {
    return std::abs(above_ground_m(p)) < kOnGround_m;
  });
  if (on_ground < kLeastOnGround) {
    return fmt::format("it holds {:.0f} % of what is seen before and behind, {:.0f} % would do",
                       100 * on_ground, 100 * kLeastOnGround);
  }
  const Points all = turned(around, mount);
  const double below = share_of(all, [&](const auto& p) {
    return above_ground_m(p) < -kBelowGround_m && std::hypot(p[0], p[1]) < kNear_m;
  });
  if (below > kMostBelow)
    return fmt::format("{:.0f} % of what is seen lies beyond it", 100 * below);
  if (has_level_above(all, mount.height_m)) {
    return "there is a level on the sensor's other side, too";
  }
  return {};
}

/// Returns text for a message: what the rejected plane may be, and which options would state its
/// mount.
std::string hint_of(const Mount& mount) {
  const std::string what = is_upside_down(mount)
                               ? "above it may be a ceiling, or the ground: is it upside down"
                               : "off may be the ground: is it tilted";
  return fmt::format(
      "a plane {:.2f} m {} (--mount-roll {:.0f} --mount-pitch {:.0f})? That is not "
      "believed, for ",
      mount.height_m, what, beams::rad_to_deg(nearest_turn(mount.roll_rad, 0)),
      beams::rad_to_deg(mount.pitch_rad));
}

/// True if there is a plane beside the sensor, which may be a wall; for a message.
bool lies_on_its_side(std::span<const std::array<float, 3>> around) {
  constexpr double kQuarter_rad = std::numbers::pi / 2;
  const auto has_plane = [&](double roll_rad, double pitch_rad) {
    const Mount turn{.height_m = 0, .roll_rad = roll_rad, .pitch_rad = pitch_rad};
    return estimate_mount(turned(around, turn)).has_value();
  };
  return has_plane(kQuarter_rad, 0) || has_plane(-kQuarter_rad, 0) || has_plane(0, kQuarter_rad) ||
         has_plane(0, -kQuarter_rad);
}

}  // namespace

Expected<MountEstimate> estimate_turned_mount(std::span<const std::array<float, 3>> strip,
                                              std::span<const std::array<float, 3>> around) {
  std::string doubts;
  for (const double base_rad : {std::numbers::pi, 0.0}) {
    for (int nth = 0; nth < (2 * kTurns + 1) * (2 * kTurns + 1); ++nth) {
      // Counts from the middle to either side: 0, 1, -1, 2, ...
      const auto steps = [](int i) { return (i % 2 == 0 ? -1 : 1) * ((i + 1) / 2); };
      const Mount turn{.height_m = 0,
                       .roll_rad = base_rad + kTurn_rad * steps(nth % (2 * kTurns + 1)),
                       .pitch_rad = kTurn_rad * steps(nth / (2 * kTurns + 1))};
      const auto seen = estimate_about(turn, strip);
      if (!seen) continue;
      const std::string doubt = doubt_of(*seen, strip, around);
      if (doubt.empty()) return seen;
      if (doubts.empty()) {
        doubts = hint_of(seen->mount) + doubt;
      }
    }
  }
  if (!doubts.empty()) return fail(ErrorCode::kMalformed, doubts);
  if (lies_on_its_side(around)) {
    return fail(
        ErrorCode::kMalformed,
        "a plane beside it may be a wall, or the ground: is it on its side (--mount-roll 90 "
        "or -90, --mount-pitch 90 or -90)?");
  }
  return fail(ErrorCode::kMalformed, "nor is one above or beside it");
}

}  // namespace terracut::mount
