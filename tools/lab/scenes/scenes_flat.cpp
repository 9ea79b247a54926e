// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <array>

#include "scene_layout.hpp"
#include "scenes.hpp"
#include "tools/lab/world/shape_makers.hpp"

namespace terracut::scenes {
namespace {

constexpr std::array<FlatSceneBox, 6> kBoxes = {{
    {15.0, 4.0, 4.2, 1.8, 1.5, world::Truth::kCar},
    {8.0, -3.0, 0.5, 0.5, 1.75, world::Truth::kPerson},
    {25.0, -6.0, 12.0, 2.5, 3.8, world::Truth::kTruck},
    {-20.0, 12.0, 10.0, 6.0, 8.0, world::Truth::kBuilding},
    {12.0, -8.0, 0.2, 0.2, 5.0, world::Truth::kPole},
    {-10.0, -7.0, 6.0, 0.4, 1.0, world::Truth::kFence},
}};

}  // namespace

std::span<const FlatSceneBox> flat_scene_boxes() noexcept {
  return kBoxes;
}

Scene make_flat_scene(const SceneExtent& extent) {
  world::Road road;
  road.left.strips = {world::Strip{.width_m = 1}};
  road.right.strips = road.left.strips;
  Scene scene{
      world::Terrain(road, extent.seed), {}, 0, extent.speed_mps < 0 ? 5.0 : extent.speed_mps};
  SceneLayout layout(scene, extent);
  for (const FlatSceneBox& known : kBoxes) {
    world::SceneObject object;
    object.shapes = {world::box({0, 0, 0}, {known.length_m, known.width_m, known.height_m},
                                {known.truth, world::Material::kFacade})};
    layout.add(object, {known.x_m, known.y_m});
  }
  return scene;
}

}  // namespace terracut::scenes
