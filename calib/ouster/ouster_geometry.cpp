// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ouster/ouster_geometry.hpp"

namespace terracut::ouster {
namespace {

using beams::Direction, beams::Point;
using Transform = std::array<double, 12>;

Direction turned(const Transform& T, const Direction& d) noexcept {
  return {T[0] * d.x + T[1] * d.y + T[2] * d.z, T[4] * d.x + T[5] * d.y + T[6] * d.z,
          T[8] * d.x + T[9] * d.y + T[10] * d.z};
}
Direction turned_back(const Transform& T, const Direction& d) noexcept {
  return {T[0] * d.x + T[4] * d.y + T[8] * d.z, T[1] * d.x + T[5] * d.y + T[9] * d.z,
          T[2] * d.x + T[6] * d.y + T[10] * d.z};
}
Point moved(const Transform& T, const Point& p) noexcept {
  const Direction there = turned(T, {p.x_m, p.y_m, p.z_m});
  return {there.x + T[3], there.y + T[7], there.z + T[11]};
}
Point moved_back(const Transform& T, const Point& p) noexcept {
  const Direction there = turned_back(T, {p.x_m - T[3], p.y_m - T[7], p.z_m - T[11]});
  return {there.x, there.y, there.z};
}

}  // namespace

OusterGeometry::OusterGeometry(const OusterCalibration& unit, double metres_per_count)
    : of_lidar_(unit.lasers, metres_per_count, unit.ahead_m),
      T_sensor_lidar_(unit.T_sensor_lidar),
      origin_counts_(unit.beam_origin_m / metres_per_count) {}

beams::Ray OusterGeometry::ray(int laser, double azimuth_rad) const noexcept {
  const beams::Ray beam = of_lidar_.ray(laser, azimuth_rad);
  return {moved(T_sensor_lidar_, beam.origin), turned(T_sensor_lidar_, beam.direction)};
}

Point OusterGeometry::point(int laser, double azimuth_rad, double counts) const noexcept {
  return moved(T_sensor_lidar_, of_lidar_.point(laser, azimuth_rad, counts - origin_counts_));
}

std::optional<double> OusterGeometry::raw_on_plane(int laser, double azimuth_rad, const Point& hit,
                                                   const Direction& normal) const noexcept {
  const auto from_beam = of_lidar_.raw_on_plane(
      laser, azimuth_rad, moved_back(T_sensor_lidar_, hit), turned_back(T_sensor_lidar_, normal));
  if (!from_beam) return std::nullopt;
  return *from_beam + origin_counts_;
}

}  // namespace terracut::ouster
