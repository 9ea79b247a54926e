// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/points/labelled_points.hpp"

#include <algorithm>
#include <cstddef>

namespace terracut::points {
namespace {

/// Returns are packed in strips of this many columns. Successive returns are the lasers of one
/// firing, one above the other in the image, so the four points of a cache line come from four
/// rows. In a strip these cache lines are still in the second-level cache when the next row needs
/// them, and runs along a row are long enough to be prefetched. By
/// tests/bench/labelled_stream_bench.cpp, packing whole rows takes 1.5 to 2 times as long for 128
/// rows, and strips of 16 columns take three times as long for 64 rows.
constexpr int kColumnsAtOnce = 256;

LabelledPoint labelled_point(const frame::Return& point, int row, frame::Label label,
                             float time_s) noexcept TERRACUT_NONBLOCKING {
  return {point.x_m, point.y_m, point.z_m, point.intensity, label, static_cast<std::uint16_t>(row),
          time_s};
}

/// Moves a laser's points in x and y, the only coordinates of a labelled point that change.
void move_where(std::uint32_t firings, const frame::TileRow<std::uint16_t>& columns,
                const frame::PlanarMotions& motion,
                frame::TilePoints& points) noexcept TERRACUT_NONBLOCKING {
  frame::for_each_firing(firings, [&](std::size_t f) noexcept {
    const std::size_t i = columns[f];
    const float x_m = points.x_m[f], y_m = points.y_m[f];
    points.x_m[f] = motion.cosine[i] * x_m - motion.sine[i] * y_m + motion.x_m[i];
    points.y_m[f] = motion.sine[i] * x_m + motion.cosine[i] * y_m + motion.y_m[i];
  });
}

/// Writes the returns of a tile. The first elements of `labels` and `points` are those of its first
/// return.
void pack_tile(const frame::MeasuredReturns& returns, std::size_t tile,
               std::span<const frame::PlanarMotions> motions, frame::TileReader& reader,
               const FrameTiming& timing, std::span<const frame::Label> labels,
               std::span<LabelledPoint> points) noexcept TERRACUT_NONBLOCKING {
  frame::TilePoints made;
  frame::TileRow<std::uint32_t> next = returns.tile(tile).first_return;
  const std::uint32_t first = next[0];
  reader.open(returns.tile(tile).heads, returns.distances(tile));
  for (std::size_t i = 0; i < returns.lasers(); ++i) {
    const std::uint32_t hits = returns.row(tile, i).returns;
    if (hits == 0) continue;
    reader.compute_points(i, all_of(made));
    const int row = reader.rows()[i];
    const RowTimes times = RowTimes::of(row, returns.shape().columns, timing);
    const frame::TileRow<std::uint16_t> columns = returns.columns(tile, i);
    const std::uint8_t* const intensity = returns.intensity(tile, i);
    if (!motions.empty()) {
      move_where(hits, columns, motions[static_cast<std::size_t>(row)], made);
    }
    frame::for_each_firing(hits, [&](std::size_t f) noexcept {
      const std::uint32_t n = next[f]++ - first;
      points[n] = labelled_point(
          {made.x_m[f], made.y_m[f], made.z_m[f], made.ground_range_m[f], intensity[f]}, row,
          labels[n], times.at(columns[f]));
    });
  }
}

}  // namespace

bool pack_labelled_points(const frame::RangeImage& image, std::span<const frame::Label> labels,
                          std::span<LabelledPoint> points,
                          const FrameTiming& timing) noexcept TERRACUT_NONBLOCKING {
  if (labels.size() != image.returns() || points.size() < labels.size()) return false;
  const int rows = image.shape().rows, columns = image.shape().columns;
  const int stride = image.shape().stride();
  for (int left = 0; left < columns; left += kColumnsAtOnce) {
    const int right = std::min(left + kColumnsAtOnce, columns);
    for (int row = 0; row < rows; ++row) {
      const RowTimes times = RowTimes::of(row, columns, timing);
      for (int column = left; column < right; ++column) {
        const std::size_t cell = image.shape().cell(row, column);
        if (!image.has_return(cell)) continue;
        const std::uint32_t n = image.return_index()[cell];
        points[n] = labelled_point({image.x_m()[cell], image.y_m()[cell], image.z_m()[cell],
                                    image.ground_range_m()[cell], image.intensity()[cell]},
                                   row, labels[n], times.at(column));
      }
    }
  }
  for (const frame::OverflowReturn& extra : image.overflow()) {
    const auto cell = static_cast<int>(extra.cell);
    const int row = cell / stride;
    points[extra.return_index] =
        labelled_point(extra.point, row, labels[extra.return_index],
                       RowTimes::of(row, columns, timing).at(cell % stride));
  }
  return true;
}

bool pack_labelled_points(const frame::MeasuredReturns& returns,
                          std::span<const frame::PlanarMotions> motions, frame::TileReader& reader,
                          std::span<const frame::Label> labels, std::span<LabelledPoint> points,
                          const FrameTiming& timing) noexcept TERRACUT_NONBLOCKING {
  if (labels.size() != returns.returns() || points.size() < labels.size()) return false;
  for (std::size_t t = 0; t < returns.tiles(); ++t) {
    const std::size_t first = returns.tile(t).first_return[0];
    pack_tile(returns, t, motions, reader, timing, labels.subspan(first), points.subspan(first));
  }
  return true;
}

void pack_labelled_tile(const frame::MeasuredReturns& returns, std::size_t tile,
                        frame::TileReader& reader, std::span<const frame::Label> labels,
                        std::span<LabelledPoint> points) noexcept TERRACUT_NONBLOCKING {
  pack_tile(returns, tile, {}, reader, {}, labels, points);
}

}  // namespace terracut::points
