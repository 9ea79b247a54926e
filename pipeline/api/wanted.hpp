// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "pipeline/scene/wanted.hpp"

namespace terracut {

/// Returns what the `Config` of a public class wants to be found; not installed.
template <class Config>
[[nodiscard]] constexpr scene::Wanted wanted_of(const Config& config) noexcept {
  return {.objects = config.objects, .free_way = config.free_way};
}
/// True if it wants heights above the ground, which what is found needs.
template <class Config>
[[nodiscard]] constexpr bool wants_heights(const Config& config) noexcept {
  return config.heights || wanted_of(config).any();
}

}  // namespace terracut
