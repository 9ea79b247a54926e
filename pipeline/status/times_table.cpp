// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/times_table.hpp"

#include <fmt/format.h>

#include <variant>

#include "rt/measure/milliseconds.hpp"

namespace terracut::status {

std::string times_table(std::span<const Figure> figures, const LineStyle& style) {
  std::string text = in_bold(fmt::format("{:<18}{:>10}{:>10}{:>10}{:>10}{:>10}", "ms", "p50", "p90",
                                         "p99", "p99.9", "max"),
                             style) +
                     '\n';
  for (const Figure& figure : figures) {
    const auto* times = std::get_if<Histogram>(&figure.value);
    if (times == nullptr || !is_shown(figure)) continue;
    text += fmt::format("{:<18}", figure.phrase.text);
    for (const double percent : {50.0, 90.0, 99.0, 99.9, 100.0}) {
      text += fmt::format("{:>10.3f}", measure::milliseconds((*times)->percentile_ns(percent)));
    }
    text += '\n';
  }
  return text;
}

}  // namespace terracut::status
