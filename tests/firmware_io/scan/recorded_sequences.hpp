// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "tests/support/places.hpp"

namespace terracut::scan {

/// Sequence folders of the labelled scans beside the repository; none where they are absent.
inline std::vector<std::filesystem::path> recorded_sequences() {
  const std::filesystem::path root = test::shared_data("semantickitti/sequences");
  std::vector<std::filesystem::path> sequences;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(root, error)) {
    sequences.push_back(entry.path());
  }
  std::sort(sequences.begin(), sequences.end());
  return sequences;
}

/// Names the sequences for a test's loop, or skips it.
#define TERRACUT_RECORDED_SEQUENCES(name)                   \
  const auto name = ::terracut::scan::recorded_sequences(); \
  if (name.empty()) GTEST_SKIP() << "no recorded scans: shared/data/semantickitti is not there"

}  // namespace terracut::scan
