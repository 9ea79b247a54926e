// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/live/wake_event.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace terracut::firmware_io {

Expected<WakeEvent> WakeEvent::make() {
  OwnedDescriptor event(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!event) {
    return fail(ErrorCode::kCapacityExceeded,
                fmt::format("eventfd: {}; `ulimit -n` is the number of files and sockets a process "
                            "may have open",
                            std::strerror(errno)));
  }
  return WakeEvent(std::move(event));
}

void WakeEvent::wake() const noexcept {
  const int kept = errno;
  const std::uint64_t one = 1;
  // Fails only when the count is full, and then the reader is awake anyway.
  static_cast<void>(!::write(event_.get(), &one, sizeof one));
  errno = kept;
}

bool WakeEvent::wait(int descriptor, std::int64_t timeout_ns) const noexcept {
  const timespec timeout = timespec_of(timeout_ns);
  std::array<pollfd, 2> polled{{{event_.get(), POLLIN, 0}, {descriptor, POLLIN, 0}}};
  if (::ppoll(polled.data(), polled.size(), &timeout, nullptr) <= 0) return false;
  std::uint64_t count = 0;
  return polled[0].revents != 0 && ::read(event_.get(), &count, sizeof count) == sizeof count;
}

}  // namespace terracut::firmware_io
