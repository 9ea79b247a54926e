// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/options.hpp"

namespace terracut::cli {

/// The data that `eval` measures on.
struct EvalSubject {
  std::string dataset;  ///< Never "hazards", but the dataset that they are put into.
  std::vector<std::filesystem::path> roots;  ///< At least one; for drives one: all scenes.
  bool with_hazards = false;
};

/// Parses `hazards DATASET ROOT...`, `hazards ROOT...` (semantickitti) and `hazards simulated` (all
/// scenes). Without `hazards`, returns the dataset and its root.
[[nodiscard]] EvalSubject subject_of(const EvalOptions& options);

}  // namespace terracut::cli
