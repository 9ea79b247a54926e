// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "tools/lab/world/random.hpp"
#include "tools/lab/world/scene_object.hpp"

namespace terracut::scenes {

/// Things that stand beside a road. Origin on the ground in their middle; long ones along x, and
/// reaching some way below the origin so that nothing gapes on slopes.

/// `length_m` along the road, `depth_m` across, `height_m` high, with a plinth.
[[nodiscard]] world::SceneObject make_building(double length_m, double depth_m, double height_m);

/// Trunk of 0.1 to 0.25 m radius, crown of leaves from 2.2 m or higher up.
[[nodiscard]] world::SceneObject make_tree(world::Random& random);

/// A bush of leaves down to the ground, 0.5 to 1.6 m across.
[[nodiscard]] world::SceneObject make_bush(world::Random& random);

/// Lamp post, sign post with its plate, or bollard.
[[nodiscard]] world::SceneObject make_lamp_post(world::Random& random);
[[nodiscard]] world::SceneObject make_sign_post(world::Random& random);
[[nodiscard]] world::SceneObject make_bollard();

/// Leaves from the ground up, 0.8 m thick.
[[nodiscard]] world::SceneObject make_hedge(double length_m, double height_m);

/// Posts and wire mesh that lets 6 beams of 10 through, 1.2 m high.
[[nodiscard]] world::SceneObject make_mesh_fence(double length_m);

/// Steel rail at 0.45 to 0.76 m on posts every 2 m.
[[nodiscard]] world::SceneObject make_guard_rail(double length_m);

/// Concrete barrier, 0.9 m high, broader at its foot.
[[nodiscard]] world::SceneObject make_concrete_barrier(double length_m);

/// A bridge over the road, deck from 5.2 m up, on two walls `clear_width_m` apart.
[[nodiscard]] world::SceneObject make_overpass(double clear_width_m);

}  // namespace terracut::scenes
