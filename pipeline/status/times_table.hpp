// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>

#include "pipeline/status/figure.hpp"
#include "pipeline/status/figure_lines.hpp"

namespace terracut::status {

/// Returns a table in milliseconds of the figures that are histograms and have a phrase, one row
/// each:
///
///   ms                       p50       p90       p99     p99.9       max
///   decode                 1.613     1.801     2.195     2.195     2.195
[[nodiscard]] std::string times_table(std::span<const Figure> figures, const LineStyle& style);

}  // namespace terracut::status
