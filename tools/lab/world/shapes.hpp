// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "hit.hpp"

namespace terracut::world {

enum class ShapeKind : std::uint8_t {
  kBox,    ///< Its top may be smaller than its bottom (cabins, wind screens).
  kPost,   ///< Upright cylinder; radius half.x.
  kWheel,  ///< Cylinder lying along y; radius half.x, half its width half.y.
  kEllipsoid,
};

/// One simple body of an object, in the object's frame: x forward, y left, z up, metres.
struct Shape {
  ShapeKind kind = ShapeKind::kBox;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d half = Eigen::Vector3d::Ones();  ///< Half its size along x, y, z.
  /// For boxes: by how much the top is smaller than the bottom at the front, the rear and both
  /// sides.
  double front_inset_m = 0, rear_inset_m = 0, side_inset_m = 0;
  Truth truth = Truth::kBuilding;
  Material material = Material::kFacade;
  /// Mean number of leaves or wires met per metre; 0 = solid.
  double density_per_m = 0;
};

/// The part of a line that lies inside a shape.
struct Chord {
  /// Distances along the line; in_m is negative if the line starts inside.
  double in_m = 0, out_m = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< Outward normal at the entry, length 1.
};

/// Intersects the shape with `line`, given in the object's frame; nothing if the line misses.
[[nodiscard]] std::optional<Chord> intersect(const Shape& shape, const SightLine& line) noexcept;

}  // namespace terracut::world
