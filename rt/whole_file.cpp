// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

namespace terracut::rt {
namespace {

Status failed(const std::filesystem::path& path, const std::string& step, int error_number) {
  return fail(
      ErrorCode::kWriteFailed,
      "could not write " + path.string() + ": " + step + ": " +
          std::generic_category().message(error_number) +
          "; nothing was left in its place. Check the folder, its rights and the free space");
}

/// 0, or the errno of the call that failed.
int write_all(int file, std::span<const std::byte> rest) {
  while (!rest.empty()) {
    const ::ssize_t written = ::write(file, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    rest = rest.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

Status write_whole_file(const std::filesystem::path& path, std::span<const std::byte> content) {
  static std::atomic<unsigned> serial{0};  // two threads may write to the same folder
  if (path.has_parent_path()) {
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) return failed(path, "making its folder", error.value());
  }
  const std::string temporary =
      path.string() + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(serial++);
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file < 0) return failed(path, "creating a temporary file beside it", errno);

  int error_number = write_all(file, content);
  std::string step = "writing";
  if (::close(file) != 0 && error_number == 0) {
    error_number = errno;
    step = "closing";
  }
  if (error_number == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) {
    error_number = errno;
    step = "renaming the temporary file to it";
  }
  if (error_number == 0) return {};
  ::unlink(temporary.c_str());
  return failed(path, step, error_number);
}

Status write_whole_file(const std::filesystem::path& path, std::string_view text) {
  return write_whole_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace terracut::rt
