// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/options.hpp"

namespace terracut::cli {

/// What `eval` measures beside labels.
enum class EvalExtra : std::uint8_t { kNone, kHazards, kObjects, kFree, kSight };

/// The data that `eval` measures on.
struct EvalSubject {
  std::string dataset;  ///< The dataset itself, never what is measured beside labels.
  std::vector<std::filesystem::path> roots;  ///< At least one; for drives one: all scenes.
  EvalExtra extra = EvalExtra::kNone;
};

/// Parses `hazards DATASET ROOT...`, `hazards ROOT...` (semantickitti) and `hazards simulated` (all
/// scenes), and the same with `objects`, `free` and `sight`. Without any of them, returns the
/// dataset and its root.
[[nodiscard]] EvalSubject subject_of(const EvalOptions& options);

}  // namespace terracut::cli
