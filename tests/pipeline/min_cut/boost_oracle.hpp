// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <vector>

#include "test_problem.hpp"

namespace terracut::test {

/// What an independent solver (Boost.Graph's boykov_kolmogorov_max_flow) says of the whole problem,
/// hard seeds as nodes, no reduction of any kind.
struct Optimum {
  std::int64_t energy = 0;
  std::vector<frame::Label> labels;  ///< Of the minimum cut with the most obstacle cells.
};
Optimum boost_optimum(const TestProblem& problem);

/// The same by trying every labelling. At most 16 unknown cells.
Optimum exhaustive_optimum(const TestProblem& problem);

}  // namespace terracut::test
