// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "measured_cells.hpp"

namespace terracut::evaluation::report {

/// Fig. 15: least, mean and largest Recall_o of the frames of every sequence, by method, with a
/// table of the numbers.
[[nodiscard]] std::string recall_section(const Json& evaluation);

/// Fig. 18 and 21: the time of every frame, how times are distributed, the worst, and every stage's
/// median, by method.
[[nodiscard]] std::string time_section(const Json& evaluation);

}  // namespace terracut::evaluation::report
