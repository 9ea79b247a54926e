// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "pipeline/status/figure.hpp"
#include "pipeline/status/named_count.hpp"

namespace terracut::status {

/// How lines for people are drawn.
struct LineStyle {
  bool colours = false;  ///< ANSI escape sequences, for terminals.
  int columns = 0;       ///< Where lines are broken; 0: nowhere.
};

/// The phrases of the figures, lines ended by '\n':
///
///   link      receiving on 0.0.0.0:2368, last packet 0.021 s ago, 34800 packets
///
/// Only printable ASCII comes out (and the escape sequences of colours), whatever their texts hold.
/// Histograms are left out: they are for times_table().
[[nodiscard]] std::string figure_lines(std::span<const Figure> figures, const LineStyle& style);

[[nodiscard]] std::string in_bold(const std::string& text, const LineStyle& style);

/// What comes from another process, for a terminal: other than printable ASCII becomes '?'.
[[nodiscard]] std::string printable(std::string_view text);

/// Those that are not 0: "kernel_drops 7, late_frames 2"; empty where all are.
[[nodiscard]] std::string counts_text(std::span<const NamedCount> counts);

}  // namespace terracut::status
