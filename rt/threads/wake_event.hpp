// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <ctime>

#include <cstdint>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::threads {

/// Waits until a descriptor can be read or another thread calls wake() (an eventfd).
class WakeEvent {
 public:
  /// Fails with kCapacityExceeded if the process has no descriptor left.
  [[nodiscard]] static Expected<WakeEvent> make();

  /// Ends the current or next wait(). Any thread or a signal handler. Keeps errno.
  void wake() const noexcept TERRACUT_NONBLOCKING;

  /// Waits until `descriptor` (-1: none) can be read or has an error, wake() is called, a signal
  /// comes, or the time is up. True if wake() was called; that call is then used up.
  [[nodiscard]] bool wait(int descriptor,
                          std::int64_t timeout_ns) const noexcept TERRACUT_NONBLOCKING;

 private:
  explicit WakeEvent(files::OwnedDescriptor event) noexcept : event_(std::move(event)) {}

  files::OwnedDescriptor event_;
};

/// Converts nanoseconds for system calls; negative times become 0.
[[nodiscard]] constexpr timespec timespec_of(std::int64_t time_ns) noexcept {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  if (time_ns < 0) time_ns = 0;
  return {static_cast<std::time_t>(time_ns / kSecond_ns), static_cast<long>(time_ns % kSecond_ns)};
}

}  // namespace terracut::threads
