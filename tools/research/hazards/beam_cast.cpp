// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "beam_cast.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "tools/lab/world/random.hpp"

namespace terracut::hazards {
namespace {

constexpr double kNoise_m = 0.015;

/// A sphere around all shapes of a hazard, in the hazard's frame.
struct Sphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

Sphere sphere_around(const Hazard& hazard) {
  Eigen::AlignedBox3d box;
  const auto add = [&](const world::Shape& shape) {
    box.extend(shape.centre - shape.half);
    box.extend(shape.centre + shape.half);
  };
  for (const world::Shape& shape : hazard.body) add(shape);
  for (const world::Shape& shape : hazard.beside) add(shape);
  if (hazard.hole) add(*hazard.hole);
  return {box.center(), box.diagonal().norm() / 2};
}

/// Returns the distance at which the line first meets one of the shapes; infinity if it meets none.
double nearest_m(std::span<const world::Shape> shapes, const world::SightLine& line,
                 world::Random& random) {
  double nearest_m = INFINITY;
  for (const world::Shape& shape : shapes) {
    const auto chord = world::intersect(shape, line);
    if (!chord || chord->in_m <= 0) continue;
    double way_m = chord->in_m;
    if (shape.density_per_m > 0) way_m -= std::log(1 - random.unit()) / shape.density_per_m;
    if (way_m <= chord->out_m) nearest_m = std::min(nearest_m, way_m);
  }
  return nearest_m;
}

/// Returns the distance to the wall or bottom of the hole; none if the line does not enter it
/// through its upper end before `range_m`.
std::optional<double> way_into(const world::Shape& hole, const world::SightLine& line,
                               double range_m) {
  constexpr double kUneven_m = 0.3;  // tolerance along a flat beam, because the ground is uneven
  const auto chord = world::intersect(hole, line);
  if (!chord || chord->in_m <= 0 || chord->normal.z() <= 0) return std::nullopt;
  if (range_m < chord->in_m - kUneven_m) return std::nullopt;
  return chord->out_m;
}

}  // namespace

MovedReturns put_in(const LabelledFrame& frame, const Hazard& hazard,
                    const Eigen::Isometry3d& T_vehicle_hazard, std::uint64_t key) {
  const Sphere sphere = sphere_around(hazard);
  const Eigen::Isometry3d T_hazard_vehicle = T_vehicle_hazard.inverse();
  const Eigen::Vector3d centre = T_vehicle_hazard * sphere.centre - frame.sensor;
  // A beam can only meet the sphere if its part towards the centre is at least as long as the
  // tangent.
  const double near_way_m2 = centre.squaredNorm() - sphere.radius_m * sphere.radius_m;
  const double least_m = near_way_m2 > 0 ? std::sqrt(near_way_m2) : -INFINITY;
  MovedReturns moved;
  for (std::uint32_t i = 0; i < frame.size(); ++i) {
    if (frame.beam[i].dot(centre) < least_m) continue;
    const world::SightLine line{T_hazard_vehicle * frame.sensor,
                                T_hazard_vehicle.linear() * frame.beam[i]};
    world::Random random(world::mix_keys(key, i));
    const double body_m = nearest_m(hazard.body, line, random);
    const double beside_m = nearest_m(hazard.beside, line, random);
    const double way_m = std::min(body_m, beside_m);
    if (way_m < frame.range_m[i]) {
      const bool counts = body_m <= beside_m && line.at(way_m).z() > kFoot_m;
      moved.push_back({i, way_m + kNoise_m * random.normal(), counts});
    } else if (hazard.hole && frame.ground[i]) {
      const auto into_m = way_into(*hazard.hole, line, frame.range_m[i]);
      if (into_m) moved.push_back({i, *into_m + kNoise_m * random.normal(), true});
    }
  }
  return moved;
}

}  // namespace terracut::hazards
