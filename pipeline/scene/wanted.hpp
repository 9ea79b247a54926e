// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

namespace terracut::scene {

/// What is to be found in labelled turns.
struct Wanted {
  bool objects = false;
  bool free_way = false;
  bool sight = false;  ///< How far the sensor sees; of turns that follow each other.

  /// Returns what is wanted of the single turn.
  [[nodiscard]] constexpr Wanted without_sight() const noexcept { return {objects, free_way}; }
  [[nodiscard]] constexpr bool any() const noexcept { return objects || free_way || sight; }
};

}  // namespace terracut::scene
