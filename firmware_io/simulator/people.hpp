// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/simulator/random.hpp"
#include "firmware_io/simulator/scene_object.hpp"

namespace terracut::firmware_io {

/// Standing or walking, 1.1 to 1.95 m tall, about 0.5 m wide; two legs.
[[nodiscard]] SceneObject make_pedestrian(Random& random);

/// A person on a bicycle, 1.75 m long, heading along x; all of it one class.
[[nodiscard]] SceneObject make_cyclist(Random& random);

}  // namespace terracut::firmware_io
