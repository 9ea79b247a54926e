// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "tools/lab/world/random.hpp"
#include "tools/lab/world/scene_object.hpp"

namespace terracut::scenes {

/// Functions that make things beside a road. The origin is on the ground in the thing's middle;
/// long things lie along x and reach below the origin, so that no gap shows on slopes.

/// Makes a building `length_m` along the road, `depth_m` across, `height_m` high, with a plinth.
[[nodiscard]] world::SceneObject make_building(double length_m, double depth_m, double height_m);

/// Makes a tree: a trunk of 0.1 to 0.25 m radius, and a crown of leaves from 2.2 m or higher up.
[[nodiscard]] world::SceneObject make_tree(world::Random& random);

/// Makes a bush of leaves down to the ground, 0.5 to 1.6 m across.
[[nodiscard]] world::SceneObject make_bush(world::Random& random);

/// Each makes one thing: a lamp post, a sign post with its plate, or a bollard.
[[nodiscard]] world::SceneObject make_lamp_post(world::Random& random);
[[nodiscard]] world::SceneObject make_sign_post(world::Random& random);
[[nodiscard]] world::SceneObject make_bollard();

/// Makes a hedge of leaves from the ground up, 0.8 m thick.
[[nodiscard]] world::SceneObject make_hedge(double length_m, double height_m);

/// Makes a fence 1.2 m high: posts, and wire mesh that lets 6 of 10 beams through.
[[nodiscard]] world::SceneObject make_mesh_fence(double length_m);

/// Makes a steel rail at 0.45 to 0.76 m on posts every 2 m.
[[nodiscard]] world::SceneObject make_guard_rail(double length_m);

/// Makes a concrete barrier, 0.9 m high, broader at its foot.
[[nodiscard]] world::SceneObject make_concrete_barrier(double length_m);

/// Makes a bridge over the road, deck from 5.2 m up, on two walls `clear_width_m` apart.
[[nodiscard]] world::SceneObject make_overpass(double clear_width_m);

}  // namespace terracut::scenes
