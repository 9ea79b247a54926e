// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "parquet_file.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// A labelled frame for ReturnsFile.
struct LabelledReturns {
  std::uint32_t frame = 0;
  std::int64_t stamp_ns = 0;  ///< Of its first packet, since 1970; 0 of clouds.
  const frame::RangeImage& image;
  std::span<const float> height_m;       ///< By cell, above the ground that the method has found.
  std::span<const frame::Label> labels;  ///< By return index.
  /// By return index: another number of the return, rising; empty: its index.
  std::span<const std::uint32_t> numbers{};
};

/// Labelled returns as a table, a row a return, a row group a frame (docs/reference/outputs.md has
/// the columns). Row by row of a frame they are the numbers of its .label file. Not thread-safe;
/// blocks on the disk.
class ReturnsFile {
 public:
  /// `metadata`: keys and values that the file shall say. The errors of ParquetFile, here as below.
  [[nodiscard]] static Expected<ReturnsFile> create(const std::filesystem::path& path,
                                                    ParquetFile::Metadata metadata);

  /// What frames of so many returns take in memory: all columns of one, and two more of the widest
  /// for what is encoded and compressed of it; besides, what zstd works with.
  [[nodiscard]] static constexpr std::size_t memory_bytes(std::size_t returns) noexcept {
    constexpr std::size_t kColumns_bytes = 6 * 4 + 8 + 4 * 4, kWidest_bytes = 8;
    constexpr std::size_t kZstd_bytes = std::size_t{2} << 20;
    return returns * (kColumns_bytes + 2 * kWidest_bytes) + kZstd_bytes;
  }

  /// A frame without returns has no rows.
  [[nodiscard]] Status add_frame(const LabelledReturns& frame);
  [[nodiscard]] Status close();

 private:
  ReturnsFile(ParquetFile file, ParquetFile::Metadata metadata);

  ParquetFile file_;
  ParquetFile::Metadata metadata_;
  std::vector<std::int32_t> frame_, return_, ring_, column_, intensity_, label_;
  std::vector<std::int64_t> stamp_ns_;
  std::vector<float> x_m_, y_m_, z_m_, height_m_;
};

}  // namespace terracut::cli
