// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/whole_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "rt/files/part_file.hpp"

namespace terracut::files {
namespace {

Status failed(const std::filesystem::path& path, const std::string& step, int error_number) {
  return fail(
      ErrorCode::kWriteFailed,
      "could not write " + path.string() + ": " + step + ": " +
          std::generic_category().message(error_number) +
          "; nothing was left in its place. Check the folder, its rights and the free space");
}

/// Writes all of `rest`. Returns 0, or the errno of the call that failed.
int write_all(int file, std::string_view rest) {
  while (!rest.empty()) {
    const ::ssize_t written = ::write(file, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

Status write_whole_file(const std::filesystem::path& path,
                        const std::function<Expected<std::string_view>()>& next) {
  if (path.has_parent_path()) {
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) return failed(path, "making its folder", error.value());
  }
  Part part = make_part_file(path);
  if (!part.lock) return failed(path, "creating a temporary file beside it", errno);

  int error_number = 0;
  auto piece = next();
  for (; error_number == 0 && piece && !piece->empty(); piece = next()) {
    error_number = write_all(part.lock.get(), *piece);
  }
  if (!piece) {
    ::unlink(part.path.c_str());
    return tl::unexpected(piece.error());
  }
  std::string step = "writing";
  // Some file systems report a full disk only at close(). So a copy of the descriptor is closed;
  // the original holds the lock until the end.
  if (error_number == 0 && ::close(::dup(part.lock.get())) != 0) {
    error_number = errno;
    step = "closing";
  }
  if (error_number == 0 && ::rename(part.path.c_str(), path.c_str()) != 0) {
    error_number = errno;
    step = "renaming the temporary file to it";
  }
  if (error_number == 0) return {};
  ::unlink(part.path.c_str());
  return failed(path, step, error_number);
}

Status write_whole_file(const std::filesystem::path& path, std::string_view text) {
  return write_whole_file(path, [&] { return std::exchange(text, {}); });
}

Status write_whole_file(const std::filesystem::path& path, std::span<const std::byte> content) {
  return write_whole_file(
      path, std::string_view(reinterpret_cast<const char*>(content.data()), content.size()));
}

}  // namespace terracut::files
