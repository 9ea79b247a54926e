// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terrain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bumps.hpp"

namespace terracut::world {
namespace {

constexpr double kMarkHalfWidth_m = 0.07;  // Marks are 4 m long, one every 10 m.
constexpr double kMarkLength_m = 4.0;
constexpr double kMarkEvery_m = 10.0;

}  // namespace

Terrain::Terrain(Road road, std::uint64_t seed)
    : road_(std::move(road)),
      seed_(seed),
      left_(road_.left),
      right_(road_.right),
      bend_per_m_(road_.grade.sharpest_bend_per_m()),
      steepest_(road_.grade.steepest() + std::max(left_.steepest(), right_.steepest()) + 0.01),
      highest_step_m_(std::max(left_.highest_step_m(), right_.highest_step_m())) {}

Terrain::Zone Terrain::zone(const Spot& spot) const noexcept {
  const double d_m = spot.road.place.d_m;
  const CrossSection& side = d_m >= 0 ? left_ : right_;
  return {&side, &side.band_at(std::abs(d_m))};
}

double Terrain::height_m(const Zone& zone, const Spot& spot) const noexcept {
  const RoadPoint& place = spot.road.place;
  const double distance_m = zone.side == &left_ ? place.d_m : -place.d_m;
  double height_m =
      road_.grade.height_m(place.s_m) + zone.side->height_m(*zone.band, place.s_m, distance_m);
  const double bumps_m = CrossSection::bumps_m(*zone.band, distance_m);
  if (bumps_m > 0) height_m += bumps_m * bumps(seed_, spot.x_m, spot.y_m);
  return height_m;
}

double Terrain::height_m(double x_m, double y_m) const noexcept {
  const Spot here = spot(x_m, y_m);
  return height_m(zone(here), here);
}

const Strip& Terrain::strip(double x_m, double y_m) const noexcept {
  return zone(spot(x_m, y_m)).band->strip;
}

Eigen::Vector3d Terrain::normal(const Zone& zone, const Spot& here) const noexcept {
  constexpr double kStep_m = 0.01;
  const auto height = [&](double x_m, double y_m) { return height_m(zone, spot(x_m, y_m)); };
  const double along = height(here.x_m + kStep_m, here.y_m) - height(here.x_m - kStep_m, here.y_m);
  const double across = height(here.x_m, here.y_m + kStep_m) - height(here.x_m, here.y_m - kStep_m);
  return Eigen::Vector3d(-along, -across, 2 * kStep_m).normalized();
}

Material Terrain::material(const Zone& zone, const Spot& spot) const noexcept {
  const Material material = zone.band->strip.material;
  if (material != Material::kAsphalt || road_.lane_mark_d_m < 0) return material;
  const RoadPoint& place = spot.road.place;
  const bool on_line = std::abs(std::abs(place.d_m) - road_.lane_mark_d_m) < kMarkHalfWidth_m;
  const bool on_dash =
      place.s_m - kMarkEvery_m * std::floor(place.s_m / kMarkEvery_m) < kMarkLength_m;
  return on_line && on_dash ? Material::kRoadPaint : material;
}

Eigen::Isometry3d stand_on(const Terrain& terrain, double x_m, double y_m, double heading_rad,
                           double half_base_m, double half_track_m) {
  const Eigen::Vector2d ahead(std::cos(heading_rad), std::sin(heading_rad));
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const auto wheel = [&](double along, double across) {
    const Eigen::Vector2d at =
        Eigen::Vector2d(x_m, y_m) + along * half_base_m * ahead + across * half_track_m * left;
    return Eigen::Vector3d(at.x(), at.y(), terrain.height_m(at.x(), at.y()));
  };
  const Eigen::Vector3d front_left = wheel(1, 1), front_right = wheel(1, -1);
  const Eigen::Vector3d rear_left = wheel(-1, 1), rear_right = wheel(-1, -1);
  const Eigen::Vector3d x_axis = (front_left + front_right - rear_left - rear_right).normalized();
  const Eigen::Vector3d across = front_left + rear_left - front_right - rear_right;
  const Eigen::Vector3d z_axis = x_axis.cross(across).normalized();

  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = x_axis;
  pose.linear().col(1) = z_axis.cross(x_axis);
  pose.linear().col(2) = z_axis;
  pose.translation() = (front_left + front_right + rear_left + rear_right) / 4;
  return pose;
}

}  // namespace terracut::world
