// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

namespace terracut::evaluation {

/// What paired differences say together.
struct PairedTest {
  std::size_t pairs = 0;
  std::size_t better = 0, worse = 0;  ///< Differences above and below 0.
  double mean = 0;
  double p = 1;  ///< Two-sided: how likely so much is where there is no difference.
};

/// Wilcoxon's signed-rank test (1945): zeros are left out, ties share their mean rank. The
/// distribution is exact up to 25 pairs without ties, else the normal approximation with correction
/// for ties and continuity (Hollander & Wolfe, Nonparametric Statistical Methods, 3.1).
[[nodiscard]] PairedTest signed_rank_test(std::span<const double> differences);

/// Sign-flip test of the mean (Fisher 1935): how many of the ways to give the differences signs
/// lead to as large a mean. Exact up to 20 differences; more are refused with
/// std::invalid_argument.
[[nodiscard]] PairedTest sign_flip_test(std::span<const double> differences);

}  // namespace terracut::evaluation
