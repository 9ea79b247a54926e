// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "pipeline/status/figure.hpp"
#include "pipeline/status/named_count.hpp"

namespace terracut::status {

/// The style of lines for people.
struct LineStyle {
  bool colours = false;  ///< Uses ANSI escape sequences, for terminals.
  int columns = 0;       ///< Column at which lines are broken; 0: never.
};

/// Returns the phrases of the figures as lines that end with '\n':
///
///   link      receiving on 0.0.0.0:2368, last packet 0.021 s ago, 34800 packets
///
/// The output is printable ASCII (plus escape sequences for colours), whatever the texts hold.
/// Histograms are left out; times_table() shows them.
[[nodiscard]] std::string figure_lines(std::span<const Figure> figures, const LineStyle& style);

[[nodiscard]] std::string in_bold(const std::string& text, const LineStyle& style);

/// Returns another process's text made safe for a terminal: any non-printable byte becomes '?'.
[[nodiscard]] std::string printable(std::string_view text);

/// Returns the counts that are not 0: "kernel_drops 7, late_frames 2"; empty if all are 0.
[[nodiscard]] std::string counts_text(std::span<const NamedCount> counts);

}  // namespace terracut::status
