// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <ctime>

#include <cstdint>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::threads {

/// Waits for a descriptor or for wake() from elsewhere (an eventfd).
class WakeEvent {
 public:
  /// Errors: kCapacityExceeded when the process has no descriptor left.
  [[nodiscard]] static Expected<WakeEvent> make();

  /// May be called from any thread or a signal handler. Keeps errno.
  void wake() const noexcept TERRACUT_NONBLOCKING;

  /// Waits until `descriptor` (-1: none) can be read or has an error, wake() is called, a signal
  /// comes, or the time is up. True when woken by wake(), which is then used up.
  [[nodiscard]] bool wait(int descriptor,
                          std::int64_t timeout_ns) const noexcept TERRACUT_NONBLOCKING;

 private:
  explicit WakeEvent(files::OwnedDescriptor event) noexcept : event_(std::move(event)) {}

  files::OwnedDescriptor event_;
};

/// Converts a time for the system's calls; negative times become 0.
[[nodiscard]] constexpr timespec timespec_of(std::int64_t time_ns) noexcept {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  if (time_ns < 0) time_ns = 0;
  return {static_cast<std::time_t>(time_ns / kSecond_ns), static_cast<long>(time_ns % kSecond_ns)};
}

}  // namespace terracut::threads
