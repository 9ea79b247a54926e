// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace terracut::evaluation::report {

/// What the paper prints in its Tables I to IX.

/// A row of Table III: means over both datasets.
struct PaperAverage {
  std::string_view method;  ///< Our name for it.
  double iou_g_percent, recall_o_percent, time_ms;
};
[[nodiscard]] std::span<const PaperAverage> paper_averages() noexcept;

/// A row of Tables IV to IX.
struct PaperRow {
  std::string_view method;         ///< Our name for it.
  std::span<const double> values;  ///< By PaperDataset::sequences.
  double mean;                     ///< As printed.
};

struct PaperTable {
  std::string_view number;   ///< "IV"
  std::string_view caption;  ///< What it shows, in our words, as HTML.
  std::span<const PaperRow> rows;

  /// Null for a method the table does not have.
  [[nodiscard]] const PaperRow* row_of(std::string_view method) const noexcept;
};

/// The tables of one dataset.
struct PaperDataset {
  std::string_view name;  ///< As `dataset` in our reports.
  std::span<const std::string_view> sequences;
  std::span<const int> scans;  ///< By sequence, Tables I and II.
  PaperTable iou_g, recall_o;  ///< Per cent.
  PaperTable time;             ///< Milliseconds.
};

/// Null for a dataset the paper does not measure on.
[[nodiscard]] const PaperDataset* paper_dataset(std::string_view name) noexcept;

/// The worst of its 24,534 frames, section IV-C.
inline constexpr double kPaperWorstFrame_ms = 95.925;

}  // namespace terracut::evaluation::report
