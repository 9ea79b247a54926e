// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/text/bounded_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace terracut::text {

Expected<std::string> read_bounded_file(const std::filesystem::path& path, std::string_view what) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no such file; expected {}", path.string(), what));
  }
  if (std::filesystem::is_directory(status)) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: is a folder; expected {}", path.string(), what));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot be opened for reading: {}", path.string(),
                            std::generic_category().message(errno)));
  }
  std::string text(kMaxFileBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) {
    return fail(ErrorCode::kUnreadable, fmt::format("{}: reading failed", path.string()));
  }
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMaxFileBytes) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: is larger than 4 MiB; expected {}, which has some 10 KiB",
                            path.string(), what));
  }
  return text;
}

}  // namespace terracut::text
