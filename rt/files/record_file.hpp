// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <bit>
#include <cstddef>
#include <filesystem>
#include <type_traits>
#include <vector>

#include "rt/error.hpp"

namespace terracut::files {

/// Describes a file of equal records without a header, for the checks and their messages.
struct RecordLayout {
  const char* record;        ///< What one record is: "point of 4 float32 (x y z remission)".
  std::size_t record_bytes;  ///< Size of one record.
  std::size_t max_records;   ///< More than this is refused before anything is read.
  bool may_be_empty = false;
};

/// Returns the number of records in `path`. Fails with kNotFound, kUnreadable, or kMalformed if the
/// file is empty, not a whole number of records, or holds more than the layout allows; the message
/// names the file, what was found and what was expected.
[[nodiscard]] Expected<std::size_t> count_records(const std::filesystem::path& path,
                                                  const RecordLayout& layout);

/// Reads `bytes` bytes from the start of `path`. Fails with kUnreadable if the file has become
/// shorter.
[[nodiscard]] Status read_bytes(const std::filesystem::path& path, void* to, std::size_t bytes);

/// Reads a file of little-endian records of type T into `records`, reusing its memory.
template <class T>
[[nodiscard]] Status read_records(const std::filesystem::path& path, const RecordLayout& layout,
                                  std::vector<T>& records) {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(std::endian::native == std::endian::little, "records are used as they stand");
  records.clear();
  const auto count = count_records(path, layout);
  if (!count) return tl::unexpected(count.error());
  records.resize(*count);
  return read_bytes(path, records.data(), *count * sizeof(T));
}

}  // namespace terracut::files
