// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "tools/lab/world/random.hpp"
#include "tools/lab/world/scene_object.hpp"

namespace terracut::scenes {

/// Makes a person, standing or walking: 1.1 to 1.95 m tall, about 0.5 m wide, on two legs.
[[nodiscard]] world::SceneObject make_pedestrian(world::Random& random);

/// Makes a person on a bicycle, 1.75 m long, heading along x; all of one class.
[[nodiscard]] world::SceneObject make_cyclist(world::Random& random);

}  // namespace terracut::scenes
