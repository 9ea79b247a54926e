// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string_view>
#include <vector>

#include "class_table.hpp"

namespace terracut::datasets {

/// A class table built into the program.
struct BuiltInTable {
  std::string_view dataset;  ///< "semantickitti"
  std::string_view yaml;
};

[[nodiscard]] const std::vector<BuiltInTable>& built_in_tables();

/// Returns the table of a dataset. For any other name fails with kInvalidArgument; the message
/// lists the existing ones.
[[nodiscard]] Expected<ClassTable> built_in_table(std::string_view dataset);

}  // namespace terracut::datasets
