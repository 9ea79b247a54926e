// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/random_field/confidence_seeds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
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

constexpr std::size_t kTogether = 32;
/// Returns a number of columns, rounded up to whole vectors.
std::size_t whole(int columns) noexcept {
  return (static_cast<std::size_t>(columns) + kTogether - 1) / kTogether * kTogether;
}

/// The windows around the cells of a row, and the share of ground from which ground is trusted.
struct TrustedWindows {
  const std::uint8_t *ground_in_column, *returns_in_column;  ///< Starting at the first window.
  int columns;                                               ///< Columns of a window.
  float ground_share;
  int share_65536;  ///< The same in 65536ths.
};

// Adds a row of labels to the counts of its columns; take_away() does the opposite.
TERRACUT_VECTOR_CLONES void add(const frame::Label* labels, std::size_t columns,
                                std::uint8_t* ground, std::uint8_t* returns) noexcept {
  for (std::size_t i = 0; i < columns; ++i) {
    ground[i] = static_cast<std::uint8_t>(ground[i] + (labels[i] == frame::Label::kGround));
  }
  for (std::size_t i = 0; i < columns; ++i) {
    returns[i] = static_cast<std::uint8_t>(returns[i] + (labels[i] != frame::Label::kNone));
  }
}
TERRACUT_VECTOR_CLONES void take_away(const frame::Label* labels, std::size_t columns,
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

// These find the returns whose ground label is trusted: enough of the window around them is ground.

/// For windows whose counts fit a byte: ground is trusted if there is more of it than
/// `windows.share_65536` 65536ths of the returns, rounded down. Works on kTogether columns at a
/// time, beyond the last one, too.
TERRACUT_VECTOR_CLONES void find_trusted_ground_small(const TrustedWindows& windows,
                                                      std::uint8_t* __restrict trusted,
                                                      std::size_t columns) noexcept {
  using Bytes = std::uint8_t __attribute__((vector_size(kTogether)));
  const auto share = static_cast<std::uint16_t>(windows.share_65536);
  const auto width = static_cast<std::size_t>(windows.columns);
  for (std::size_t first = 0; first < columns; first += kTogether) {
    Bytes ground{}, returns{};
    for (std::size_t i = first; i < first + width; ++i) {
      Bytes more_ground, more_returns;
      std::memcpy(&more_ground, windows.ground_in_column + i, sizeof(Bytes));
      std::memcpy(&more_returns, windows.returns_in_column + i, sizeof(Bytes));
      ground += more_ground;
      returns += more_returns;
    }
    std::uint8_t ground_of[kTogether], returns_of[kTogether];
    std::memcpy(ground_of, &ground, sizeof(Bytes));
    std::memcpy(returns_of, &returns, sizeof(Bytes));
    for (std::size_t i = 0; i < kTogether; ++i) {
      const auto bound = static_cast<std::uint16_t>(std::uint32_t{returns_of[i]} * share >> 16U);
      trusted[first + i] = ground_of[i] > bound;
    }
  }
}
TERRACUT_VECTOR_CLONES void find_trusted_ground_large(const TrustedWindows& windows,
                                                      std::uint16_t* __restrict ground,
                                                      std::uint16_t* __restrict returns,
                                                      std::span<std::uint8_t> trusted) noexcept {
  const std::size_t columns = trusted.size();
  sum_windows(windows.ground_in_column, windows.columns, columns, ground);
  sum_windows(windows.returns_in_column, windows.columns, columns, returns);
  std::uint8_t* const __restrict out = trusted.data();
  for (std::size_t i = 0; i < columns; ++i) {
    out[i] = static_cast<float>(ground[i]) > windows.ground_share * static_cast<float>(returns[i]);
  }
}

/// Returns the number of 65536ths that stands for a share of up to `most` returns; -1 if there is
/// none that decides for every number of them as the share does.
int in_65536ths(float share, int most) {
  const auto decides_alike = [&](int share_65536) {
    for (int returns = 0; returns <= most; ++returns) {
      const auto whole = static_cast<float>(returns * share_65536 / 65536);
      const float bound = share * static_cast<float>(returns);
      if (whole > bound || whole + 1 <= bound) return false;
    }
    return true;
  };
  if (most > std::numeric_limits<std::uint8_t>::max()) return -1;
  // No farther from the share than a float is from a number.
  const auto near = static_cast<int>(share * 65536);
  for (int share_65536 = near; share_65536 <= std::min(near + 2, 65535); ++share_65536) {
    if (decides_alike(share_65536)) return share_65536;
  }
  return -1;
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
          "seeds",
          static_cast<std::size_t>(shape.columns + 2 * config.window_columns) + kTogether)),
      returns_in_column_(memory.take<std::uint8_t>("seeds", ground_in_column_.size())),
      sums_(memory.take<std::uint16_t>("seeds", 2 * static_cast<std::size_t>(shape.columns))),
      trusted_ground_(memory.take<std::uint8_t>("seeds", sums_.size() / 2 + kTogether)) {
  const stage::RowSteps row_steps(profile, static_cast<double>(row_step_deg));
  for (int row = 0; row < shape.rows; ++row) {
    const auto i = static_cast<std::size_t>(row);
    window_begin_[i] = std::max(0, row_steps.down(row, config.window_rows));
    window_end_[i] = std::min(shape.rows, row_steps.up(row, config.window_rows) + 1);
    most_in_window_ = std::max(
        most_in_window_, (window_end_[i] - window_begin_[i]) * (2 * config.window_columns + 1));
  }
  share_65536_ = in_65536ths(config.ground_share, most_in_window_);
}

void ConfidenceSeeds::select(const stage::CellPlanes& planes, frame::ColumnRange columns) noexcept {
  start_counting(columns);
  for (int row = 0; row < shape_.rows; ++row) {
    const std::size_t first = shape_.cell(row, columns.begin);
    const std::span<const frame::Label> labels = planes.label.subspan(first, columns.size());
    const std::span<min_cut::Seed> seeds = seeds_.subspan(first, columns.size());
    if (row < cut_rows_) {
      const std::span<std::uint8_t> trusted = trusted_ground_.first(columns.size());
      count_in_columns(planes, row, columns);
      find_trusted_ground(trusted);
      choose(labels.data(), trusted.data(), seeds);
    } else {
      std::ranges::transform(labels, seeds.begin(),
                             [](frame::Label label) noexcept { return kept(label); });
    }
  }
}

void ConfidenceSeeds::start_counting(frame::ColumnRange columns) noexcept {
  const std::size_t counted = whole(static_cast<int>(columns.size()) + 2 * reach());
  std::ranges::fill(ground_in_column_.first(counted), std::uint8_t{0});
  std::ranges::fill(returns_in_column_.first(counted), std::uint8_t{0});
  counted_begin_ = counted_end_ = 0;
}

void ConfidenceSeeds::count_in_columns(const stage::CellPlanes& planes, int row,
                                       frame::ColumnRange columns) noexcept {
  static_assert(kTogether <= stage::kReadBeyond);
  // Adds a row to the counts or takes it away again; its columns go on beyond the seam. The last
  // piece is made longer, to whole vectors: what is counted there is not read.
  const auto count_row = [&](int r, bool enters) noexcept {
    const int begin = columns.begin - reach(), end = columns.end + reach();
    for (int at = begin; at < end;) {
      const int column = (at + 8 * shape_.columns) % shape_.columns;
      const int piece = std::min(end - at, shape_.columns - column);
      const auto count = at + piece < end ? static_cast<std::size_t>(piece) : whole(piece);
      const auto i = static_cast<std::size_t>(at - begin);
      const frame::Label* const labels = &planes.label[shape_.cell(r, column)];
      if (enters) {
        add(labels, count, &ground_in_column_[i], &returns_in_column_[i]);
      } else {
        take_away(labels, count, &ground_in_column_[i], &returns_in_column_[i]);
      }
      at += piece;
    }
  };
  // Windows only move upwards, so every row enters once and leaves once.
  for (; counted_end_ < window_end_[static_cast<std::size_t>(row)]; ++counted_end_) {
    count_row(counted_end_, true);
  }
  for (; counted_begin_ < window_begin_[static_cast<std::size_t>(row)]; ++counted_begin_) {
    count_row(counted_begin_, false);
  }
}

void ConfidenceSeeds::find_trusted_ground(std::span<std::uint8_t> trusted) noexcept {
  const TrustedWindows windows{ground_in_column_.data(), returns_in_column_.data(),
                               2 * config_.window_columns + 1, config_.ground_share, share_65536_};
  const std::size_t columns = trusted.size();
  if (share_65536_ >= 0) {
    find_trusted_ground_small(windows, trusted.data(), columns);
  } else {
    find_trusted_ground_large(windows, sums_.data(), &sums_[columns], trusted);
  }
}

}  // namespace terracut::random_field
