// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/hesai/models.hpp"
#include "input.hpp"

namespace terracut::fuzz {

/// Calls `use` with the std::type_identity of a model that the input chooses.
template <class Use>
void with_any_hesai(Input& input, const Use& use) {
  hesai::Models::with(hesai::kLayouts[input.next(1) % hesai::kLayouts.size()].model, use);
}

}  // namespace terracut::fuzz
