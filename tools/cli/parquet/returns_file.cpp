// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "returns_file.hpp"

#include <array>
#include <utility>

#include "firmware_io/frame/each_return.hpp"
#include "pipeline/output/label_sink.hpp"

namespace terracut::cli {
namespace {

using Kind = ParquetColumn::Kind;

std::vector<ParquetColumn> columns() {
  return {{"frame", Kind::kUint32}, {"return", Kind::kCounter}, {"stamp", Kind::kStamp_ns},
          {"ring", Kind::kUint16},  {"column", Kind::kUint16},  {"x", Kind::kFloat},
          {"y", Kind::kFloat},      {"z", Kind::kFloat},        {"intensity", Kind::kUint8},
          {"label", Kind::kUint8},  {"height", Kind::kFloat}};
}

}  // namespace

Expected<ReturnsFile> ReturnsFile::create(const std::filesystem::path& path,
                                          ParquetFile::Metadata metadata) {
  auto file = ParquetFile::create(path, columns());
  if (!file) return tl::unexpected(file.error());
  return ReturnsFile(*std::move(file), std::move(metadata));
}

ReturnsFile::ReturnsFile(ParquetFile file, ParquetFile::Metadata metadata)
    : file_(std::move(file)), metadata_(std::move(metadata)) {}

Status ReturnsFile::add_frame(const LabelledReturns& frame) {
  const std::size_t rows = frame.labels.size();
  if (rows == 0) return {};
  frame_.assign(rows, static_cast<std::int32_t>(frame.frame));
  stamp_ns_.assign(rows, frame.stamp_ns);
  for (auto* const column : {&return_, &ring_, &column_, &intensity_, &label_}) {
    column->resize(rows);
  }
  for (auto* const column : {&x_m_, &y_m_, &z_m_, &height_m_}) column->resize(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    return_[i] = static_cast<std::int32_t>(frame.numbers.empty() ? i : frame.numbers[i]);
    label_[i] = static_cast<std::int32_t>(output::semantic_kitti_class(frame.labels[i]));
  }
  frame::for_each_return(frame.image, [&](const frame::PlacedReturn& placed) {
    const std::size_t i = placed.return_index;
    const std::size_t cell = frame.image.shape().cell(placed.row, placed.column);
    ring_[i] = placed.row;
    column_[i] = placed.column;
    x_m_[i] = placed.point.x_m;
    y_m_[i] = placed.point.y_m;
    z_m_[i] = placed.point.z_m;
    intensity_[i] = placed.point.intensity;
    // Of a second return in a cell, above the ground that the first was judged by.
    height_m_[i] = frame.height_m[cell] + (placed.point.z_m - frame.image.z_m()[cell]);
  });
  const std::array<ParquetValues, 11> values{std::span<const std::int32_t>(frame_),
                                             std::span<const std::int32_t>(return_),
                                             std::span<const std::int64_t>(stamp_ns_),
                                             std::span<const std::int32_t>(ring_),
                                             std::span<const std::int32_t>(column_),
                                             std::span<const float>(x_m_),
                                             std::span<const float>(y_m_),
                                             std::span<const float>(z_m_),
                                             std::span<const std::int32_t>(intensity_),
                                             std::span<const std::int32_t>(label_),
                                             std::span<const float>(height_m_)};
  return file_.add_row_group(values);
}

Status ReturnsFile::close() {
  return file_.close(metadata_, "terracut version " TERRACUT_VERSION);
}

}  // namespace terracut::cli
