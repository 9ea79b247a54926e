// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <pybind11/pybind11.h>

namespace terracut::python {

/// Binds GroundGrid, whose numpy arrays are copies of its cells.
void bind_ground_grid(pybind11::module_& module);

}  // namespace terracut::python
