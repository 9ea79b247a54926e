// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "measured_cells.hpp"

namespace terracut::evaluation::report {

/// Sections of the page with what the paper does not measure. `evaluation` is that of
/// evaluation_json.hpp.

/// Precision, recall and F1 of ground, and the same without vegetation.
[[nodiscard]] std::string measure_section(const Json& evaluation);
/// IoU_g and Recall_o by distance.
[[nodiscard]] std::string range_section(const Json& evaluation);
/// Which share of every class is called ground, by method.
[[nodiscard]] std::string class_section(const Json& evaluation);

}  // namespace terracut::evaluation::report
