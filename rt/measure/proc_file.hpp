// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::measure {

/// A file of /proc that is kept open and read repeatedly from its beginning, without opening or
/// allocating anything. Movable.
class ProcFile {
 public:
  /// Opens the file. Fails with kNotFound or kUnreadable, and the system's reason.
  [[nodiscard]] static Expected<ProcFile> open(const char* path);

  /// Returns as much of the file as `buffer` holds; empty if the file can no longer be read. Makes
  /// one system call, which waits for no disk: the kernel writes the text during the call.
  [[nodiscard]] std::string_view read(std::span<char> buffer) const noexcept TERRACUT_NONBLOCKING;

 private:
  explicit ProcFile(files::OwnedDescriptor file) noexcept : file_(std::move(file)) {}
  files::OwnedDescriptor file_;
};

/// Returns number `n`, counted from 0, of a line of numbers between blanks; -1 if there is no such
/// number or it does not fit.
[[nodiscard]] std::int64_t nth_number(std::string_view line, int n) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::measure
