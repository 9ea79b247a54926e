// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "shapes.hpp"

namespace terracut::world {

/// The material and class of a shape.
struct Substance {
  Truth truth = Truth::kBuilding;
  Material material = Material::kFacade;
  double density_per_m = 0;  ///< See Shape::density_per_m.
};

/// These make shapes whose foot has its middle at `bottom`.
[[nodiscard]] inline Shape box(const Eigen::Vector3d& bottom, const Eigen::Vector3d& size,
                               const Substance& substance) {
  Shape shape;
  shape.kind = ShapeKind::kBox;
  shape.half = size / 2;
  shape.centre = bottom + Eigen::Vector3d(0, 0, shape.half.z());
  shape.truth = substance.truth;
  shape.material = substance.material;
  shape.density_per_m = substance.density_per_m;
  return shape;
}

[[nodiscard]] inline Shape post(const Eigen::Vector3d& bottom, double radius_m, double height_m,
                                const Substance& substance) {
  Shape shape = box(bottom, {2 * radius_m, 2 * radius_m, height_m}, substance);
  shape.kind = ShapeKind::kPost;
  return shape;
}

[[nodiscard]] inline Shape ellipsoid(const Eigen::Vector3d& bottom, const Eigen::Vector3d& size,
                                     const Substance& substance) {
  Shape shape = box(bottom, size, substance);
  shape.kind = ShapeKind::kEllipsoid;
  return shape;
}

/// Makes a wheel that stands on `bottom`, with its axle along y.
[[nodiscard]] inline Shape wheel(const Eigen::Vector3d& bottom, double radius_m, double width_m,
                                 const Substance& substance) {
  Shape shape = box(bottom, {2 * radius_m, width_m, 2 * radius_m}, substance);
  shape.kind = ShapeKind::kWheel;
  return shape;
}

}  // namespace terracut::world
