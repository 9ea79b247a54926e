// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "pipeline/ground/profile.hpp"
#include "terracut/segmenter.hpp"

namespace terracut {

/// Returns the parameters of a public profile; not installed.
[[nodiscard]] inline ground::SegmenterConfig config_of(Profile profile) noexcept {
  return profile == Profile::kPaper ? ground::paper_profile() : ground::terracut_profile();
}

}  // namespace terracut
