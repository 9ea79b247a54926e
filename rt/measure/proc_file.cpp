// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/measure/proc_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace terracut::measure {

Expected<ProcFile> ProcFile::open(const char* path) {
  files::OwnedDescriptor file(::open(path, O_RDONLY | O_CLOEXEC));
  if (file) return ProcFile(std::move(file));
  const int error_number = errno;
  return fail(error_number == ENOENT ? ErrorCode::kNotFound : ErrorCode::kUnreadable,
              std::string("could not open ") + path + ": " +
                  std::generic_category().message(error_number) +
                  "; this kernel or container does not tell");
}

std::string_view ProcFile::read(std::span<char> buffer) const noexcept TERRACUT_NONBLOCKING {
  // read() does not wait here: /proc has no device behind it.
  const ::ssize_t got = threads::trusted_call(
      [&]() noexcept { return ::pread(file_.get(), buffer.data(), buffer.size(), 0); });
  return {buffer.data(), got > 0 ? static_cast<std::size_t>(got) : 0};
}

std::int64_t nth_number(std::string_view line, int n) noexcept TERRACUT_NONBLOCKING {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (;; --n) {
    while (at != end && *at == ' ') ++at;
    if (n == 0) break;
    while (at != end && *at >= '0' && *at <= '9') ++at;
    if (at == end || *at != ' ') return -1;
  }
  std::int64_t number = 0;
  bool any = false;
  for (; at != end && *at >= '0' && *at <= '9'; ++at, any = true) {
    const int digit = *at - '0';
    if (number > (INT64_MAX - digit) / 10) return -1;
    number = number * 10 + digit;
  }
  return any ? number : -1;
}

}  // namespace terracut::measure
