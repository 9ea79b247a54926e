// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/labelled_points.hpp"

#include <algorithm>
#include <cstddef>

#include "pipeline/output/label_sink.hpp"

namespace terracut::stream {
namespace {

/// Neighbours in arrival are the lasers of one firing, which lie one above the other in the image:
/// four points of a cache line come from four rows. In strips of this width those lines are still
/// in the second-level cache when the next row comes to them, and runs along a row are still long
/// enough to be fetched ahead. tests/bench/labelled_stream_bench.cpp: whole rows cost one and a
/// half times to twice as much on 128 rows, strips of 16 columns three times as much on 64.
constexpr int kColumnsAtOnce = 256;

LabelledPoint labelled_point(const frame::Return& point, int row,
                             frame::Label label) noexcept TERRACUT_NONBLOCKING {
  return {point.x_m,
          point.y_m,
          point.z_m,
          point.intensity,
          static_cast<std::uint8_t>(output::semantic_kitti_class(label)),
          static_cast<std::uint16_t>(row)};
}

}  // namespace

bool pack_labelled_points(const frame::RangeImage& image, std::span<const frame::Label> labels,
                          std::span<LabelledPoint> points) noexcept TERRACUT_NONBLOCKING {
  if (labels.size() != image.returns() || points.size() < labels.size()) return false;
  const int rows = image.shape().rows, columns = image.shape().columns;
  const int stride = image.shape().stride();
  for (int left = 0; left < columns; left += kColumnsAtOnce) {
    const int right = std::min(left + kColumnsAtOnce, columns);
    for (int row = 0; row < rows; ++row) {
      const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(stride);
      for (std::size_t cell = first + static_cast<std::size_t>(left);
           cell < first + static_cast<std::size_t>(right); ++cell) {
        if (!image.has_return(cell)) continue;
        const std::uint32_t n = image.return_index()[cell];
        points[n] = labelled_point({image.x_m()[cell], image.y_m()[cell], image.z_m()[cell],
                                    image.ground_range_m()[cell], image.intensity()[cell]},
                                   row, labels[n]);
      }
    }
  }
  for (const frame::OverflowReturn& extra : image.overflow()) {
    points[extra.return_index] = labelled_point(extra.point, static_cast<int>(extra.cell) / stride,
                                                labels[extra.return_index]);
  }
  return true;
}

}  // namespace terracut::stream
