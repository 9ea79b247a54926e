// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/options.hpp"

namespace terracut::cli {

/// What `eval` measures on.
struct EvalSubject {
  std::string dataset;  ///< EvalOptions::dataset; of hazards the dataset they are put into.
  std::vector<std::filesystem::path> roots;  ///< At least one; of drives one, all their scenes.
  bool with_hazards = false;
};

/// Reads `hazards DATASET ROOT...`, `hazards ROOT...` (semantickitti) and `hazards simulated` (all
/// scenes); else the subject is the dataset and its root.
[[nodiscard]] EvalSubject subject_of(const EvalOptions& options);

}  // namespace terracut::cli
