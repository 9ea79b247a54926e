// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "rt/error.hpp"
#include "rt/files/part_file.hpp"
#include "thrift_compact.hpp"

struct ZSTD_CCtx_s;  // libzstd's ZSTD_CCtx

namespace terracut::cli {

/// A column without nulls, as the file says of it.
struct ParquetColumn {
  enum class Kind : std::uint8_t {
    kUint8,
    kUint16,
    kUint32,
    kCounter,  ///< uint32 that rises from row to row
    kStamp_ns,
    kFloat
  };
  std::string name;
  Kind kind;
};

/// A column's values of a row group: whole numbers, stamps, floats, by its kind.
using ParquetValues = std::variant<std::span<const std::int32_t>, std::span<const std::int64_t>,
                                   std::span<const float>>;

/// An Apache Parquet file (parquet-format 2.10), written group by group: a page a column and group,
/// compressed by zstd with its checksum and summed up by the page's own, least and greatest values
/// of both, and what the caller says of it as keys with values. It has a temporary name until
/// close(); without that nothing is left. Not thread-safe; blocks on the disk.
class ParquetFile {
 public:
  using Metadata = std::vector<std::pair<std::string, std::string>>;

  /// kWriteFailed.
  [[nodiscard]] static Expected<ParquetFile> create(std::filesystem::path path,
                                                    std::vector<ParquetColumn> columns);
  ParquetFile(ParquetFile&&) noexcept = default;
  ParquetFile& operator=(ParquetFile&&) = delete;
  ~ParquetFile();

  /// `values`: of each column as many, by its kind; at least one row. kWriteFailed.
  [[nodiscard]] Status add_row_group(std::span<const ParquetValues> values);
  /// Completes the file and gives it its name. kWriteFailed. Nothing may follow.
  [[nodiscard]] Status close(const Metadata& metadata, const std::string& created_by);

 private:
  /// A column of a row group, where it lies.
  struct Chunk {
    std::int64_t offset = 0, plain_bytes = 0, bytes = 0;  ///< With the page's header.
    std::string least, greatest;                          ///< Empty: not known.
  };
  struct RowGroup {
    std::int64_t rows = 0;
    std::vector<Chunk> chunks;
  };
  struct FreeCompressor {
    void operator()(ZSTD_CCtx_s* compressor) const noexcept;
  };

  ParquetFile(std::filesystem::path path, files::Part part, std::vector<ParquetColumn> columns);
  [[nodiscard]] Expected<Chunk> add_chunk(const ParquetColumn& column, const ParquetValues& values);
  [[nodiscard]] Status write(std::string_view bytes);
  /// Of one column of a row group, into the footer.
  static void describe(ThriftCompact& footer, const ParquetColumn& column, std::int64_t rows,
                       const Chunk& chunk);
  [[nodiscard]] std::string footer(const Metadata& metadata, const std::string& created_by) const;

  std::filesystem::path path_;
  files::Part part_;
  std::vector<ParquetColumn> columns_;
  std::unique_ptr<ZSTD_CCtx_s, FreeCompressor> compressor_;
  std::string compressed_;
  std::vector<RowGroup> groups_;
  std::int64_t bytes_ = 0;  ///< Written so far.
};

}  // namespace terracut::cli
