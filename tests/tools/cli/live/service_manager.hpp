// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace terracut::cli {

/// What systemd is to a service: a socket that takes datagrams, and the environment that names it.
class Service : public test::InScratchFolder {
 protected:
  void TearDown() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
    if (manager_ >= 0) ::close(manager_);
  }

  void listen(const std::string& name) {
    manager_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    ASSERT_LT(name.size(), sizeof address.sun_path);
    std::memcpy(address.sun_path, name.data(), name.size());
    if (name.front() == '@') address.sun_path[0] = '\0';
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    ASSERT_EQ(::bind(manager_, reinterpret_cast<const sockaddr*>(&address), length), 0);
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  /// The next message, or nothing.
  [[nodiscard]] std::string heard() const {
    char bytes[1024];
    const ssize_t size = ::recv(manager_, bytes, sizeof bytes, MSG_DONTWAIT);
    return size < 0 ? std::string() : std::string(bytes, static_cast<std::size_t>(size));
  }
  int manager_ = -1;
};

}  // namespace terracut::cli
