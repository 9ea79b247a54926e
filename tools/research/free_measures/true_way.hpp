// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <vector>

#include "pipeline/free_way/free_way.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/hazards/labelled_frame.hpp"

namespace terracut::free_measures {

/// Returns for each sector of `free_way` the horizontal distance to the nearest return of a class
/// that is no ground and that is as high above the true ground as its configuration asks for;
/// infinity if there is none. Returns that no class says anything about count nowhere, and so do
/// those without true ground within 2 m.
[[nodiscard]] std::vector<float> true_obstacles_m(const hazards::LabelledFrame& frame,
                                                  const datasets::ClassTable& classes,
                                                  const free_way::FreeWay& free_way,
                                                  const free_way::FreeWay::Config& config);

/// Returns the number of the sector that has a column.
[[nodiscard]] std::size_t sector_of(const free_way::FreeWay& free_way, int column);

}  // namespace terracut::free_measures
