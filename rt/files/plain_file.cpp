// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/plain_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace terracut::files {
namespace {

tl::unexpected<Error> unreadable(const std::filesystem::path& path, const std::string& why) {
  return fail(ErrorCode::kUnreadable, path.string() + ": " + why);
}

tl::unexpected<Error> refused(const std::filesystem::path& path, int error_number) {
  const std::string why = std::generic_category().message(error_number);
  if (error_number == ENOENT) return fail(ErrorCode::kNotFound, path.string() + ": " + why);
  return unreadable(path, why);
}

}  // namespace

Expected<OwnedDescriptor> open_plain_file(const std::filesystem::path& path) {
  // O_NONBLOCK keeps open() from waiting if the path is a named pipe.
  OwnedDescriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat status{};
  if (!file || ::fstat(file.get(), &status) != 0) return refused(path, errno);
  if (S_ISDIR(status.st_mode)) return unreadable(path, "a folder, where a file was expected");
  if (!S_ISREG(status.st_mode)) {
    return unreadable(path, "a pipe or device, where a plain file was expected");
  }
  return file;
}

Status check_readable_twice(const std::filesystem::path& path) {
  struct stat status{};
  if (::stat(path.c_str(), &status) != 0) return {};
  const auto refuse = [&](const char* what) {
    return unreadable(
        path, std::string("is a ") + what + " and cannot be read twice; write it to a file first");
  };
  if (S_ISFIFO(status.st_mode)) return refuse("pipe");
  if (S_ISSOCK(status.st_mode)) return refuse("socket");
  if (S_ISCHR(status.st_mode)) return refuse("device");
  return {};
}

Expected<std::string> read_plain_file(const std::filesystem::path& path, std::size_t most_bytes) {
  auto file = open_plain_file(path);
  if (!file) return tl::unexpected(file.error());
  std::string text;
  std::array<char, std::size_t{1} << 16> part{};
  for (;;) {
    const ::ssize_t read = ::read(file->get(), part.data(), part.size());
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) return refused(path, errno);
    if (read == 0) return text;
    text.append(part.data(), static_cast<std::size_t>(read));
    if (text.size() > most_bytes) {
      return unreadable(path,
                        "longer than the " + std::to_string(most_bytes) + " bytes expected here");
    }
  }
}

}  // namespace terracut::files
