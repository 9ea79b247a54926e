// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/record_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "rt/files/plain_file.hpp"

namespace terracut::files {

Expected<std::size_t> count_records(const std::filesystem::path& path, const RecordLayout& layout) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: no such file", path.string()));
  }
  if (!std::filesystem::is_regular_file(status)) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: expected a file, found a folder or device", path.string()));
  }
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error) {
    return fail(ErrorCode::kUnreadable, fmt::format("{}: {}", path.string(), error.message()));
  }
  if (bytes == 0 && !layout.may_be_empty) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: empty; expected at least one {}", path.string(), layout.record));
  }
  if (bytes % layout.record_bytes != 0) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: truncated: {} bytes are not a whole number of {} bytes a {}; the "
                            "last whole one ends at byte {}",
                            path.string(), bytes, layout.record_bytes, layout.record,
                            bytes - bytes % layout.record_bytes));
  }
  if (bytes / layout.record_bytes > layout.max_records) {
    return fail(
        ErrorCode::kMalformed,
        fmt::format("{}: {} records, expected at most {}, one frame; one record is a {}",
                    path.string(), bytes / layout.record_bytes, layout.max_records, layout.record));
  }
  return static_cast<std::size_t>(bytes / layout.record_bytes);
}

Status read_bytes(const std::filesystem::path& path, void* to, std::size_t bytes) {
  // A pipe may have replaced the file since its records were counted.
  const auto file = open_plain_file(path);
  if (!file) return tl::unexpected(file.error());
  std::size_t done = 0;
  while (done < bytes) {
    const ::ssize_t read = ::read(file->get(), static_cast<char*>(to) + done, bytes - done);
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) break;
    done += static_cast<std::size_t>(read);
  }
  if (done == bytes) return {};
  return fail(ErrorCode::kUnreadable, fmt::format("{}: expected {} bytes, the system delivered {}",
                                                  path.string(), bytes, done));
}

}  // namespace terracut::files
