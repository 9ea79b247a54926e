// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rt/error.hpp"
#include "scene_names.hpp"
#include "tools/lab/world/scene_object.hpp"
#include "tools/lab/world/terrain.hpp"

namespace terracut::scenes {

/// An arc that is tangent to the road at one moment of a drive.
struct EgoArc {
  double yaw_rate_radps = 0;  ///< Positive to the left.
  double touches_s = 0;       ///< Time of the touch since the drive's start.
};

/// A world and the path of the sensor's vehicle: from s = 0 at time 0 along the road, or along an
/// arc that touches the road and leaves it.
struct Scene {
  world::Terrain terrain;
  std::vector<world::SceneObject> objects;
  double ego_d_m = 0;  ///< The vehicle's distance from the centre line, left positive.
  double ego_speed_mps = 0;
  std::optional<EgoArc> ego_arc = std::nullopt;
};

/// The extent of the world that a drive sees.
struct SceneExtent {
  std::uint64_t seed = 1;
  double duration_s = 5;
  double speed_mps = -1;  ///< < 0: the scene's usual speed.
};

/// Makes a scene. The same name and seed give the same world; a longer drive sees everything that a
/// shorter one sees, and more. Fails with kInvalidArgument for an unknown name; the message lists
/// scene_names().
[[nodiscard]] Expected<Scene> make_scene(std::string_view name, const SceneExtent& extent);

/// A box of the scene "flat", standing on the plane.
struct FlatSceneBox {
  double x_m = 0, y_m = 0;                         ///< Position of the middle.
  double length_m = 0, width_m = 0, height_m = 0;  ///< Along x, y, z.
  world::Truth truth = world::Truth::kBuilding;
};
[[nodiscard]] std::span<const FlatSceneBox> flat_scene_boxes() noexcept;

}  // namespace terracut::scenes
