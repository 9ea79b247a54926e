// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "rt/files/owned_descriptor.hpp"

namespace terracut::cli {

/// Receives SIGUSR1, which asks a running process for a dump, without a handler: the signal is
/// blocked and read from a descriptor, so it interrupts no thread and no system call.
///
/// Construct it in main() before any other thread starts: threads inherit the block, and in a
/// thread without it the signal would end the process.
class DumpSignal {
 public:
  /// Throws std::system_error if the system has no descriptor left.
  DumpSignal();

  /// True if the signal came since the last call. Never waits. For any one thread.
  [[nodiscard]] bool take() noexcept;

  /// Returns a descriptor for poll(), readable when take() would return true.
  [[nodiscard]] int descriptor() const noexcept { return descriptor_.get(); }

 private:
  files::OwnedDescriptor descriptor_;
};

}  // namespace terracut::cli
