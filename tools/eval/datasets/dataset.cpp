// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "dataset.hpp"

#include "koblenz.hpp"
#include "semantic_kitti.hpp"

namespace terracut::evaluation {

std::unique_ptr<Dataset> dataset_at(DatasetLayout layout, const std::filesystem::path& root) {
  if (layout == DatasetLayout::kKoblenz) return std::make_unique<Koblenz>(root);
  return std::make_unique<SemanticKitti>(root);
}

}  // namespace terracut::evaluation
