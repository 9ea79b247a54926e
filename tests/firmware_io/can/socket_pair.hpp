// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>

#include "firmware_io/can/can_wire.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::test {

/// Two ends that stand for a bus: what is written to one comes out of the other, a frame a
/// datagram.
struct SocketPair {
  files::OwnedDescriptor here, there;

  SocketPair() {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()), 0);
    here = files::OwnedDescriptor(ends[0]);
    there = files::OwnedDescriptor(ends[1]);
  }
  /// False when the other end takes no more.
  bool put(const can::CanFrame& frame) const {
    std::array<std::uint8_t, can::kFdWireBytes> bytes{};
    const std::size_t size = write_can_wire(frame, bytes);
    return ::send(there.get(), bytes.data(), size, 0) == static_cast<::ssize_t>(size);
  }
};

}  // namespace terracut::test
