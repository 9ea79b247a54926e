// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stage/portable_math.hpp"

#include <cmath>
#include <numbers>

namespace terracut::stage {

double portable_log(double x) noexcept {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // [0.5, 1), exact
  if (mantissa < std::numbers::sqrt2 / 2) {
    mantissa *= 2;
    --exponent;
  }
  // Uses ln(m) = 2 atanh(s) with s = (m - 1) / (m + 1), |s| < 0.172: seven terms reach 1e-12.
  const double s = (mantissa - 1) / (mantissa + 1);
  const double s2 = s * s;
  double series = 0;
  for (int power = 13; power >= 1; power -= 2) series = series * s2 + 1.0 / power;
  return 2 * s * series + exponent * std::numbers::ln2;
}

NegativeExp::NegativeExp() noexcept {
  // exp(-i / 64) is computed as the i-th power of exp(-1 / 64), whose Taylor series needs only IEEE
  // operations.
  const double x = -1.0 / static_cast<double>(kStepsPerUnit);
  const double one_step =
      1 + x * (1 + x / 2 * (1 + x / 3 * (1 + x / 4 * (1 + x / 5 * (1 + x / 6)))));
  double value = 1;
  for (float& entry : table_) {
    entry = static_cast<float>(value);
    value *= one_step;
  }
}

}  // namespace terracut::stage
