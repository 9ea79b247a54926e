// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "tools/lab/world/random.hpp"
#include "tools/lab/world/scene_object.hpp"

namespace terracut::scenes {

/// Functions that make motor vehicles: origin on the ground below the middle, heading along x.
/// Size, colour and kind vary with `random`; the caller sets position and speed.

/// Makes a car 3.8 to 4.8 m long, 1.75 to 1.9 m wide, 1.45 to 1.7 m high; 0.18 to 0.24 m of air
/// below.
[[nodiscard]] world::SceneObject make_car(world::Random& random);

/// Makes a tractor and trailer, 12 to 16.5 m long, 2.5 m wide, 3.6 to 4 m high; open below.
[[nodiscard]] world::SceneObject make_truck(world::Random& random);

}  // namespace terracut::scenes
