// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/trusted_file.hpp"

#include <unistd.h>

#include <string>

namespace terracut::files {

bool is_trusted_owner(::uid_t owner, ::uid_t reader) noexcept {
  constexpr ::uid_t kFirstPerson = 1000, kFirstDynamic = 61184, kLastDynamic = 65519;
  return owner == reader || owner < kFirstPerson ||
         (owner >= kFirstDynamic && owner <= kLastDynamic);
}

Status check_trusted(const struct ::stat& file, const std::filesystem::path& path) {
  if (!S_ISREG(file.st_mode)) {
    return fail(ErrorCode::kUnreadable, path.string() + " is no plain file");
  }
  if (!is_trusted_owner(file.st_uid, ::geteuid())) {
    return fail(ErrorCode::kUnreadable,
                path.string() + " belongs to user " + std::to_string(file.st_uid) +
                    ", who is neither you, root nor a service: it may say anything. Look as that "
                    "user");
  }
  if ((file.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    return fail(ErrorCode::kUnreadable,
                path.string() + " may be written to by others than its owner: it may say anything");
  }
  return {};
}

}  // namespace terracut::files
