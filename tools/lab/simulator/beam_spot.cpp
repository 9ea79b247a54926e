// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "beam_spot.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "tools/lab/world/random.hpp"

namespace terracut::simulator {
namespace {

constexpr std::uint64_t kBesideTheAxis = 0x5BE5;  // makes its random numbers differ from the axis's
/// Half the length of a 5 ns pulse. Echoes nearer to each other than this merge.
constexpr double kSeparable_m = 0.75;
/// Two places are on one surface if each lies this near to the other's tangent plane. (Slanting
/// ground spreads one pulse over metres without splitting it.)
constexpr double kOnePlane_m = 0.15;

double off_plane_m(const world::Hit& hit, const Eigen::Vector3d& at, const Eigen::Vector3d& other) {
  return std::abs(hit.normal.dot(other - at));
}

}  // namespace

SideLine side_line(const world::SightLine& axis, double half_width_rad,
                   std::uint64_t ray_key) noexcept {
  const std::uint64_t key = world::mix_keys(ray_key, kBesideTheAxis);
  world::Random random(key);
  const double angle_rad = random.uniform(0, 2 * std::numbers::pi);
  const double aside = half_width_rad * std::sqrt(random.unit());  // uniform over the disc
  const double share = random.uniform(0.25, 1.0);
  const Eigen::Vector3d right = axis.direction.unitOrthogonal();
  const Eigen::Vector3d up = axis.direction.cross(right);
  const Eigen::Vector3d direction =
      axis.direction + aside * (std::cos(angle_rad) * right + std::sin(angle_rad) * up);
  return {{axis.origin, direction.normalized()}, share, key};
}

bool one_echo(const world::SightLine& axis, const world::Hit& on_axis, const world::SightLine& side,
              const world::Hit& on_side) noexcept {
  if (std::abs(on_axis.way_m - on_side.way_m) < kSeparable_m) return true;
  const Eigen::Vector3d a = axis.at(on_axis.way_m), b = side.at(on_side.way_m);
  return off_plane_m(on_axis, a, b) < kOnePlane_m && off_plane_m(on_side, b, a) < kOnePlane_m;
}

}  // namespace terracut::simulator
