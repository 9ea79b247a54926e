// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/robosense/models.hpp"
#include "input.hpp"

namespace terracut::fuzz {

/// Calls `use` with the std::type_identity of a model that the input chooses.
template <class Use>
void with_any_robosense(Input& input, const Use& use) {
  robosense::Models::with(robosense::kLayouts[input.next(1) % robosense::kLayouts.size()].model,
                          use);
}

}  // namespace terracut::fuzz
