// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "measured_cells.hpp"

namespace terracut::evaluation::report {

/// What the page's tables are put together from; cells of numbers are in measured_cells.hpp.

inline constexpr std::string_view kAllGround = "IoU<sub>g</sub>, all ground";
inline constexpr std::string_view kRoadGround = "IoU<sub>g</sub>, road alone";

/// A column's title, as HTML.
[[nodiscard]] std::string header(std::string_view html);
/// A row's first two cells: whose, as text, and what of it, as HTML.
[[nodiscard]] std::string row_name(std::string_view name, std::string_view what);
/// "everything_ground" in words.
[[nodiscard]] std::string oracle_title(std::string_view name);
/// All methods in the order of the evaluation.
[[nodiscard]] std::vector<std::string> method_names(const Json& evaluation);
/// Whether a method told any ground to be no road surface.
[[nodiscard]] bool tells_road(const Json& method);
/// Whether any of the methods did.
[[nodiscard]] bool any_tells_road(const Json& evaluation);

}  // namespace terracut::evaluation::report
