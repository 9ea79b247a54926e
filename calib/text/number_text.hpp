// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace terracut::text {

/// Returns `text`, except for spaces around it, as a number; nothing if any other part is not a
/// number ("12 cm", "0,5", ""). Independent of the locale. May return NaN or infinity if the text
/// says so.
[[nodiscard]] std::optional<double> number_from(std::string_view text) noexcept;

/// Returns the number in `text` times 10^exponent, rounded once: "123.7" and -2 give exactly 1.237,
/// which 123.7 * 0.01 need not. So changing units between writing and reading loses no bit.
[[nodiscard]] std::optional<double> number_from(std::string_view text, int exponent);

/// Returns the shortest text for which number_from(text, exponent) is exactly `value` (finite).
[[nodiscard]] std::string text_of(double value, int exponent);

/// Returns the 1-based number of the line that holds byte `offset` of `text`.
[[nodiscard]] int line_of(std::string_view text, std::size_t offset) noexcept;

}  // namespace terracut::text
