// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "parquet_file.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <new>
#include <string_view>
#include <system_error>

#include "column_encoding.hpp"

namespace terracut::cli {
namespace {

using Kind = ParquetColumn::Kind;

constexpr std::string_view kMagic = "PAR1";
constexpr int kZstdLevel = 1;  // 3 saves a hundredth of the bytes for a tenth more time

// Numbers of parquet-format's parquet.thrift.
enum Type : std::int32_t { kInt32 = 1, kInt64 = 2, kFloatType = 4 };
enum Converted : std::int32_t { kUint8Text = 11, kUint16Text = 12, kUint32Text = 13 };
enum Encoding : std::int32_t { kPlain = 0, kRle = 3, kDelta = 5, kByteStreamSplit = 9 };
constexpr std::int32_t kRequired = 0, kDataPage = 0, kZstdCodec = 6;

Type type_of(Kind kind) {
  if (kind == Kind::kStamp_ns) return kInt64;
  return kind == Kind::kFloat ? kFloatType : kInt32;
}

Encoding encoding_of(Kind kind) {
  if (kind == Kind::kFloat) return kByteStreamSplit;
  return kind == Kind::kCounter ? kDelta : kPlain;
}

struct Encoded {
  std::string bytes, least, greatest;
};

template <class Value>
std::string bytes_of(Value value) {
  return plain(std::span<const Value>(&value, 1));
}

Encoded encode(Kind kind, const ParquetValues& values) {
  return std::visit(
      [&]<class Value>(std::span<const Value> of) {
        const auto [least, greatest] = std::ranges::minmax_element(of);
        Encoded encoded{{}, bytes_of(*least), bytes_of(*greatest)};
        if constexpr (std::is_same_v<Value, float>) {
          encoded.bytes = byte_stream_split(of);
          // No order with a NaN among them; and readers may not tell the two zeros apart.
          if (std::ranges::any_of(of, [](float value) { return std::isnan(value); })) {
            encoded.least = encoded.greatest = {};
          } else {
            if (*least == 0) encoded.least = bytes_of(-0.0F);
            if (*greatest == 0) encoded.greatest = bytes_of(0.0F);
          }
        } else if constexpr (std::is_same_v<Value, std::int32_t>) {
          encoded.bytes = kind == Kind::kCounter ? delta_binary_packed(of) : plain(of);
        } else {
          encoded.bytes = plain(of);
        }
        return encoded;
      },
      values);
}

std::size_t rows_in(const ParquetValues& values) {
  return std::visit([](const auto& of) { return of.size(); }, values);
}

/// `compressed`: the page behind it, whose CRC-32 it has.
std::string page_header(Kind kind, std::size_t rows, std::size_t plain_bytes,
                        std::string_view compressed) {
  const auto crc = static_cast<std::uint32_t>(
      ::crc32_z(0, reinterpret_cast<const Bytef*>(compressed.data()), compressed.size()));
  ThriftCompact header;
  header.i32(1, kDataPage);
  header.i32(2, static_cast<std::int32_t>(plain_bytes));
  header.i32(3, static_cast<std::int32_t>(compressed.size()));
  header.i32(4, std::bit_cast<std::int32_t>(crc));
  header.begin_struct(5);
  header.i32(1, static_cast<std::int32_t>(rows));
  header.i32(2, encoding_of(kind));
  header.i32(3, kRle);  // of the levels, of which a column without nulls has none
  header.i32(4, kRle);
  header.end_struct();
  return header.take();
}

void add_schema(ThriftCompact& footer, const ParquetColumn& column) {
  footer.begin_element();
  footer.i32(1, type_of(column.kind));
  footer.i32(3, kRequired);
  footer.text(4, column.name);
  if (column.kind == Kind::kStamp_ns) {
    footer.begin_struct(10);  // the logical type, which has no older name
    footer.begin_struct(8);   // a timestamp
    footer.boolean(1, true);  // in UTC
    footer.begin_struct(2);   // in units
    footer.begin_struct(3);   // of nanoseconds
    for (int i = 0; i < 4; ++i) footer.end_struct();
  } else if (column.kind != Kind::kFloat) {
    footer.i32(6, column.kind == Kind::kUint8    ? kUint8Text
                  : column.kind == Kind::kUint16 ? kUint16Text
                                                 : kUint32Text);
  }
  footer.end_element();
}

tl::unexpected<Error> write_failed(const std::filesystem::path& path, int error_number) {
  return fail(ErrorCode::kWriteFailed,
              fmt::format("could not write {}: {}; nothing was left in its place. Check the "
                          "folder, its rights and the free space",
                          path.string(), std::generic_category().message(error_number)));
}

}  // namespace

void ParquetFile::FreeCompressor::operator()(ZSTD_CCtx_s* compressor) const noexcept {
  ZSTD_freeCCtx(compressor);
}

Expected<ParquetFile> ParquetFile::create(std::filesystem::path path,
                                          std::vector<ParquetColumn> columns) {
  if (path.has_parent_path()) {
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) return write_failed(path, error.value());
  }
  files::Part part = files::make_part_file(path);
  if (!part.lock) return write_failed(path, errno);
  ParquetFile file(std::move(path), std::move(part), std::move(columns));
  if (Status begun = file.write(kMagic); !begun) return tl::unexpected(begun.error());
  return file;
}

ParquetFile::ParquetFile(std::filesystem::path path, files::Part part,
                         std::vector<ParquetColumn> columns)
    : path_(std::move(path)),
      part_(std::move(part)),
      columns_(std::move(columns)),
      compressor_(ZSTD_createCCtx()) {
  if (!compressor_) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(compressor_.get(), ZSTD_c_compressionLevel, kZstdLevel);
  ZSTD_CCtx_setParameter(compressor_.get(), ZSTD_c_checksumFlag, 1);
}

ParquetFile::~ParquetFile() {
  if (part_.lock) ::unlink(part_.path.c_str());
}

Status ParquetFile::add_row_group(std::span<const ParquetValues> values) {
  RowGroup group{static_cast<std::int64_t>(rows_in(values.front())), {}};
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    auto chunk = add_chunk(columns_[i], values[i]);
    if (!chunk) return tl::unexpected(chunk.error());
    group.chunks.push_back(*std::move(chunk));
  }
  groups_.push_back(std::move(group));
  return {};
}

Expected<ParquetFile::Chunk> ParquetFile::add_chunk(const ParquetColumn& column,
                                                    const ParquetValues& values) {
  Encoded encoded = encode(column.kind, values);
  compressed_.resize(ZSTD_compressBound(encoded.bytes.size()));
  const std::size_t bytes =
      ZSTD_compress2(compressor_.get(), compressed_.data(), compressed_.size(),
                     encoded.bytes.data(), encoded.bytes.size());
  if (ZSTD_isError(bytes) != 0) {
    return fail(ErrorCode::kWriteFailed, path_.string() + ": " + ZSTD_getErrorName(bytes));
  }
  const auto page = std::string_view(compressed_).substr(0, bytes);
  const std::string header = page_header(column.kind, rows_in(values), encoded.bytes.size(), page);
  Chunk chunk{bytes_, static_cast<std::int64_t>(header.size() + encoded.bytes.size()),
              static_cast<std::int64_t>(header.size() + bytes), std::move(encoded.least),
              std::move(encoded.greatest)};
  Status written = write(header);
  if (written) written = write(page);
  if (!written) return tl::unexpected(written.error());
  return chunk;
}

Status ParquetFile::close(const Metadata& metadata, const std::string& created_by) {
  const std::string last = footer(metadata, created_by);
  const auto length = static_cast<std::uint32_t>(last.size());
  Status written = write(last);
  if (written) written = write(bytes_of(length));
  if (written) written = write(kMagic);
  if (!written) return written;
  // Some file systems tell only at a close that the disk is full. The lock is held until the end.
  if (::close(::dup(part_.lock.get())) != 0 ||
      std::rename(part_.path.c_str(), path_.c_str()) != 0) {
    return write_failed(path_, errno);
  }
  part_.lock.close();
  return {};
}

Status ParquetFile::write(std::string_view bytes) {
  bytes_ += static_cast<std::int64_t>(bytes.size());
  while (!bytes.empty()) {
    const ::ssize_t written = ::write(part_.lock.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return write_failed(path_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

void ParquetFile::describe(ThriftCompact& footer, const ParquetColumn& column, std::int64_t rows,
                           const Chunk& chunk) {
  using Element = ThriftCompact::Element;
  footer.begin_element();
  footer.i64(2, chunk.offset);
  footer.begin_struct(3);
  footer.i32(1, type_of(column.kind));
  footer.list(2, Element::kI32, 2);
  footer.element(encoding_of(column.kind));
  footer.element(kRle);
  footer.list(3, Element::kText, 1);
  footer.element(column.name);
  footer.i32(4, kZstdCodec);
  footer.i64(5, rows);
  footer.i64(6, chunk.plain_bytes);
  footer.i64(7, chunk.bytes);
  footer.i64(9, chunk.offset);
  footer.begin_struct(12);
  footer.i64(3, 0);  // nulls
  if (!chunk.least.empty()) {
    footer.text(5, chunk.greatest);
    footer.text(6, chunk.least);
  }
  footer.end_struct();
  footer.end_struct();
  footer.end_element();
}

std::string ParquetFile::footer(const Metadata& metadata, const std::string& created_by) const {
  using Element = ThriftCompact::Element;
  ThriftCompact footer;
  footer.i32(1, 2);  // version
  footer.list(2, Element::kStruct, columns_.size() + 1);
  footer.begin_element();
  footer.text(4, "schema");
  footer.i32(5, static_cast<std::int32_t>(columns_.size()));
  footer.end_element();
  for (const ParquetColumn& column : columns_) add_schema(footer, column);

  std::int64_t rows = 0;
  for (const RowGroup& group : groups_) rows += group.rows;
  footer.i64(3, rows);
  footer.list(4, Element::kStruct, groups_.size());
  for (const RowGroup& group : groups_) {
    std::int64_t plain_bytes = 0, bytes = 0;
    footer.begin_element();
    footer.list(1, Element::kStruct, columns_.size());
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Chunk& chunk = group.chunks[i];
      plain_bytes += chunk.plain_bytes;
      bytes += chunk.bytes;
      describe(footer, columns_[i], group.rows, chunk);
    }
    footer.i64(2, plain_bytes);
    footer.i64(3, group.rows);
    footer.i64(5, group.chunks.front().offset);
    footer.i64(6, bytes);
    footer.end_element();
  }
  footer.list(5, Element::kStruct, metadata.size());
  for (const auto& [key, value] : metadata) {
    footer.begin_element();
    footer.text(1, key);
    footer.text(2, value);
    footer.end_element();
  }
  footer.text(6, created_by);
  footer.list(7, Element::kStruct, columns_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) {  // least and greatest are by the type's order
    footer.begin_element();
    footer.begin_struct(1);
    footer.end_struct();
    footer.end_element();
  }
  return footer.take();
}

}  // namespace terracut::cli
