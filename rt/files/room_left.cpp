// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/room_left.hpp"

#include <fmt/format.h>
#include <sys/statvfs.h>

#include <cerrno>
#include <system_error>

namespace terracut::files {

Status check_room_left(const std::filesystem::path& path) {
  struct statvfs space{};
  std::filesystem::path at = path.empty() ? "." : path;
  while (::statvfs(at.c_str(), &space) != 0) {
    if (errno == EINTR) continue;
    if ((errno != ENOENT && errno != ENOTDIR) || !at.has_relative_path()) {
      return fail(ErrorCode::kWriteFailed,
                  fmt::format("{}: its free space is not known: {}", path.string(),
                              std::generic_category().message(errno)));
    }
    at = at.has_parent_path() ? at.parent_path() : ".";
  }
  const std::uint64_t free_bytes = std::uint64_t{space.f_bavail} * space.f_frsize;
  const std::uint64_t others = room_for_others(std::uint64_t{space.f_blocks} * space.f_frsize);
  if (free_bytes > others) return {};
  return fail(ErrorCode::kWriteFailed,
              fmt::format("{}: no room: {} bytes are free, and recordings leave {} to others",
                          path.string(), free_bytes, others));
}

}  // namespace terracut::files
