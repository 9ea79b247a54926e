// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/random_field/confidence_seeds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "pipeline/stage/row_steps.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::random_field {

namespace {

int rows_to_cut(CutRows rows, const mount::RingProfile& profile, const frame::ImageShape& shape) {
  constexpr int kMostRowsToCutAll = 64;
  const bool all =
      rows == CutRows::kAll || (rows == CutRows::kAuto && shape.rows <= kMostRowsToCutAll);
  return all ? shape.rows : stage::rows_that_meet_ground(profile);
}

/// Returns the seed by which a cell keeps the label of earlier stages.
min_cut::Seed kept(frame::Label label) noexcept {
  switch (label) {
    case frame::Label::kNone:
      return min_cut::Seed::kNone;
    case frame::Label::kGround:
    case frame::Label::kOtherGround:
      return min_cut::Seed::kGround;
    case frame::Label::kObstacle:
      return min_cut::Seed::kObstacle;
  }
  return min_cut::Seed::kNone;
}

/// The windows around the cells of a row, and the share of ground from which ground is trusted.
struct TrustedWindows {
  const std::uint8_t *ground_in_column, *returns_in_column;  ///< Starting at the first window.
  int columns;                                               ///< Columns of a window.
  float ground_share;
};

// Adds a row of labels to the counts of its columns; uncount() removes it.
TERRACUT_VECTOR_CLONES void count(const frame::Label* labels, std::size_t columns,
                                  std::uint8_t* ground, std::uint8_t* returns) noexcept {
  for (std::size_t i = 0; i < columns; ++i) {
    ground[i] = static_cast<std::uint8_t>(ground[i] + (labels[i] == frame::Label::kGround));
  }
  for (std::size_t i = 0; i < columns; ++i) {
    returns[i] = static_cast<std::uint8_t>(returns[i] + (labels[i] != frame::Label::kNone));
  }
}
TERRACUT_VECTOR_CLONES void uncount(const frame::Label* labels, std::size_t columns,
                                    std::uint8_t* ground, std::uint8_t* returns) noexcept {
  for (std::size_t i = 0; i < columns; ++i) {
    ground[i] = static_cast<std::uint8_t>(ground[i] - (labels[i] == frame::Label::kGround));
  }
  for (std::size_t i = 0; i < columns; ++i) {
    returns[i] = static_cast<std::uint8_t>(returns[i] - (labels[i] != frame::Label::kNone));
  }
}

/// Computes sums[i] = counts[i] + .. + counts[i + width - 1].
template <class Sum>
[[gnu::always_inline]] inline void sum_windows(const std::uint8_t* __restrict counts, int width,
                                               std::size_t columns, Sum* __restrict sums) noexcept {
  for (std::size_t i = 0; i < columns; ++i) sums[i] = counts[i];
  for (int offset = 1; offset < width; ++offset) {
    const std::uint8_t* const __restrict shifted = counts + offset;
    for (std::size_t i = 0; i < columns; ++i) sums[i] = static_cast<Sum>(sums[i] + shifted[i]);
  }
}

/// Finds the returns whose ground label is trusted: enough of the window around them is ground.
/// `Sum` must be able to hold the count of a window.
template <class Sum>
[[gnu::always_inline]] inline void find_trusted_ground(const TrustedWindows& windows,
                                                       Sum* __restrict ground,
                                                       Sum* __restrict returns,
                                                       std::span<std::uint8_t> trusted) noexcept {
  const std::size_t columns = trusted.size();
  sum_windows(windows.ground_in_column, windows.columns, columns, ground);
  sum_windows(windows.returns_in_column, windows.columns, columns, returns);
  std::uint8_t* const __restrict out = trusted.data();
  for (std::size_t i = 0; i < columns; ++i) {
    out[i] = static_cast<float>(ground[i]) > windows.ground_share * static_cast<float>(returns[i]);
  }
}
TERRACUT_VECTOR_CLONES void find_trusted_ground_small(const TrustedWindows& windows,
                                                      std::uint8_t* ground, std::uint8_t* returns,
                                                      std::span<std::uint8_t> trusted) noexcept {
  find_trusted_ground(windows, ground, returns, trusted);
}
TERRACUT_VECTOR_CLONES void find_trusted_ground_large(const TrustedWindows& windows,
                                                      std::uint16_t* ground, std::uint16_t* returns,
                                                      std::span<std::uint8_t> trusted) noexcept {
  find_trusted_ground(windows, ground, returns, trusted);
}

/// Keeps obstacles and trusted ground, and makes other ground unknown. Has no branches: they would
/// be mispredicted wherever ground and obstacles alternate.
TERRACUT_VECTOR_CLONES void choose(const frame::Label* __restrict label,
                                   const std::uint8_t* __restrict trusted_ground,
                                   std::span<min_cut::Seed> seeds) noexcept {
  static_assert(
      static_cast<int>(min_cut::Seed::kNone) == static_cast<int>(frame::Label::kNone) &&
      static_cast<int>(min_cut::Seed::kGround) == static_cast<int>(frame::Label::kGround) &&
      static_cast<int>(min_cut::Seed::kObstacle) == static_cast<int>(frame::Label::kObstacle));
  const std::size_t columns = seeds.size();
  min_cut::Seed* const __restrict out = seeds.data();
  for (std::size_t i = 0; i < columns; ++i) {
    const bool trusted = ((label[i] == frame::Label::kGround) & (trusted_ground[i] != 0)) |
                         (label[i] == frame::Label::kObstacle);
    const min_cut::Seed otherwise =
        label[i] == frame::Label::kNone ? min_cut::Seed::kNone : min_cut::Seed::kUnknown;
    out[i] = trusted ? static_cast<min_cut::Seed>(label[i]) : otherwise;
  }
}

}  // namespace

ConfidenceSeeds::ConfidenceSeeds(const Config& config, float row_step_deg,
                                 const mount::RingProfile& profile, frame::ImageShape shape,
                                 memory::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      cut_rows_(rows_to_cut(config.rows, profile, shape)),
      window_begin_(memory.take<std::int32_t>("seeds", static_cast<std::size_t>(shape.rows))),
      window_end_(memory.take<std::int32_t>("seeds", window_begin_.size())),
      seeds_(memory.take<min_cut::Seed>("seeds", shape.cells())),
      ground_in_column_(memory.take<std::uint8_t>(
          "seeds", static_cast<std::size_t>(shape.columns + 2 * config.window_columns))),
      returns_in_column_(memory.take<std::uint8_t>("seeds", ground_in_column_.size())),
      sums_(memory.take<std::uint16_t>("seeds", 2 * static_cast<std::size_t>(shape.columns))),
      trusted_ground_(memory.take<std::uint8_t>("seeds", sums_.size() / 2)) {
  const stage::RowSteps row_steps(profile, static_cast<double>(row_step_deg));
  for (int row = 0; row < shape.rows; ++row) {
    const auto i = static_cast<std::size_t>(row);
    window_begin_[i] = std::max(0, row_steps.down(row, config.window_rows));
    window_end_[i] = std::min(shape.rows, row_steps.up(row, config.window_rows) + 1);
    most_in_window_ = std::max(
        most_in_window_, (window_end_[i] - window_begin_[i]) * (2 * config.window_columns + 1));
  }
}

void ConfidenceSeeds::select(const stage::CellPlanes& planes) noexcept {
  const std::size_t cut_cells =
      static_cast<std::size_t>(cut_rows_) * static_cast<std::size_t>(shape_.stride());
  std::transform(planes.label.begin() + static_cast<std::ptrdiff_t>(cut_cells), planes.label.end(),
                 seeds_.begin() + static_cast<std::ptrdiff_t>(cut_cells),
                 [](frame::Label label) noexcept { return kept(label); });
  start_counting();
  for (int row = 0; row < cut_rows_; ++row) {
    count_in_columns(planes, row);
    select_in_row(planes, row);
  }
}

void ConfidenceSeeds::select_in_row(const stage::CellPlanes& planes, int row) noexcept {
  const std::size_t first =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(shape_.stride());
  find_trusted_ground_in_row();
  choose(&planes.label[first], trusted_ground_.data(),
         seeds_.subspan(first, trusted_ground_.size()));
}

void ConfidenceSeeds::start_counting() noexcept {
  std::fill(ground_in_column_.begin(), ground_in_column_.end(), std::uint8_t{0});
  std::fill(returns_in_column_.begin(), returns_in_column_.end(), std::uint8_t{0});
  counted_begin_ = counted_end_ = 0;
}

void ConfidenceSeeds::count_in_columns(const stage::CellPlanes& planes, int row) noexcept {
  const auto labels_of = [&](int r) {
    return &planes.label[static_cast<std::size_t>(r) * static_cast<std::size_t>(shape_.stride())];
  };
  const auto reach = static_cast<std::size_t>(config_.window_columns);
  const auto columns = static_cast<std::size_t>(shape_.columns);
  std::uint8_t* ground = &ground_in_column_[reach];
  std::uint8_t* returns = &returns_in_column_[reach];
  // Windows only move upwards, so every row is added once and removed once.
  for (; counted_end_ < window_end_[static_cast<std::size_t>(row)]; ++counted_end_) {
    count(labels_of(counted_end_), columns, ground, returns);
  }
  for (; counted_begin_ < window_begin_[static_cast<std::size_t>(row)]; ++counted_begin_) {
    uncount(labels_of(counted_begin_), columns, ground, returns);
  }
  for (std::span<std::uint8_t> counts : {ground_in_column_, returns_in_column_}) {
    for (std::size_t i = 0; i < reach; ++i) {
      counts[i] = counts[columns + i];
      counts[reach + columns + i] = counts[reach + i];
    }
  }
}

void ConfidenceSeeds::find_trusted_ground_in_row() noexcept {
  const TrustedWindows windows{ground_in_column_.data(), returns_in_column_.data(),
                               2 * config_.window_columns + 1, config_.ground_share};
  const std::size_t columns = trusted_ground_.size();
  if (most_in_window_ <= std::numeric_limits<std::uint8_t>::max()) {
    auto* const sums = reinterpret_cast<std::uint8_t*>(sums_.data());
    find_trusted_ground_small(windows, sums, sums + columns, trusted_ground_);
  } else {
    find_trusted_ground_large(windows, sums_.data(), &sums_[columns], trusted_ground_);
  }
}

}  // namespace terracut::random_field
