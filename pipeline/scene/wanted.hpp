// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

namespace terracut::scene {

/// What is to be found in labelled turns.
struct Wanted {
  bool objects = false;
  bool free_way = false;

  [[nodiscard]] constexpr bool any() const noexcept { return objects || free_way; }
};

}  // namespace terracut::scene
