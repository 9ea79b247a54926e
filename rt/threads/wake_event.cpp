// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/threads/wake_event.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace terracut::threads {

Expected<WakeEvent> WakeEvent::make() {
  files::OwnedDescriptor event(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!event) {
    return fail(ErrorCode::kCapacityExceeded,
                fmt::format("eventfd: {}; `ulimit -n` is the number of files and sockets a process "
                            "may have open",
                            std::strerror(errno)));
  }
  return WakeEvent(std::move(event));
}

void WakeEvent::wake() const noexcept {
  // A write to a non-blocking eventfd returns at once. It fails only when the count is full; then
  // the reader is awake anyway.
  trusted_call([this]() noexcept {
    const int kept = errno;
    const std::uint64_t one = 1;
    static_cast<void>(!::write(event_.get(), &one, sizeof one));
    errno = kept;
  });
}

bool WakeEvent::wait(int descriptor, std::int64_t timeout_ns) const noexcept {
  const timespec timeout = timespec_of(timeout_ns);
  std::array<pollfd, 2> polled{{{event_.get(), POLLIN, 0}, {descriptor, POLLIN, 0}}};
  // Threads with a deadline wait here for their work.
  const int ready = trusted_call(
      [&]() noexcept { return ::ppoll(polled.data(), polled.size(), &timeout, nullptr); });
  if (ready <= 0 || polled[0].revents == 0) return false;
  // A read from a non-blocking eventfd returns at once.
  return trusted_call([this]() noexcept {
    std::uint64_t count = 0;
    return ::read(event_.get(), &count, sizeof count) == sizeof count;
  });
}

}  // namespace terracut::threads
