// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "measured_cells.hpp"

namespace terracut::evaluation::report {

/// Sections of the page: what was measured beside what the paper prints. `evaluation` is that of
/// evaluation_json.hpp.

/// Table III: the modules of the method, and every other method that was measured.
[[nodiscard]] std::string average_section(const Json& evaluation);
/// Tables IV to VI, or VII to IX, by sequence; says so where the paper has no such table.
[[nodiscard]] std::string sequence_section(const Json& evaluation);

}  // namespace terracut::evaluation::report
