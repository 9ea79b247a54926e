// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/can/can_sender.hpp"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <utility>

#include "firmware_io/can/can_socket.hpp"
#include "firmware_io/can/can_wire.hpp"
#include "firmware_io/net/network_interface.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::can {
namespace {

constexpr std::int64_t kLookEvery_ns = 500'000'000;

}  // namespace

Expected<CanSender> CanSender::open(std::string interface, bool wait_for_interface) {
  CanSender sender;
  sender.probe_ = files::OwnedDescriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const net::InterfaceStatus status = net::interface_status(sender.probe_.get(), interface);
  if (status.state != net::LinkState::kGone) {
    auto socket = open_can_socket(status.index, {}, false);
    if (!socket) return tl::unexpected(explain(socket.error(), interface));
    sender.socket_ = *std::move(socket);
  } else if (!wait_for_interface) {
    return tl::unexpected(net::no_such_interface(interface));
  }
  sender.interface_index_ = status.index;
  sender.interface_ = std::move(interface);
  return sender;
}

CanSender CanSender::adopt(files::OwnedDescriptor descriptor) {
  CanSender sender;
  sender.socket_ = std::move(descriptor);
  return sender;
}

std::size_t CanSender::send(std::span<const CanFrame> frames) noexcept {
  std::size_t sent_now = 0;
  for (const CanFrame& frame : frames) {
    if (send(frame)) ++sent_now;
  }
  counters_.sent += sent_now;
  return sent_now;
}

bool CanSender::send(const CanFrame& frame) noexcept {
  if (!socket_) {
    ++counters_.link_down;
    look_after_interface();
    return false;
  }
  std::array<std::uint8_t, kFdWireBytes> bytes;
  const std::size_t size = write_can_wire(frame, bytes);
  const auto written = ::send(socket_.get(), bytes.data(), size, MSG_DONTWAIT | MSG_NOSIGNAL);
  if (written == static_cast<::ssize_t>(size)) return true;
  counters_.last_error = errno;
  switch (errno) {
    case ENOBUFS:
    case EAGAIN:
      ++counters_.queue_full;
      return false;
    case ENETDOWN:
    case ENODEV:
    case ENXIO:
      ++counters_.link_down;
      look_after_interface();
      return false;
    default:
      ++counters_.failed;
      return false;
  }
}

/// Opens a new socket if the interface was lost and is back: the old socket stays tied to the lost
/// interface.
void CanSender::look_after_interface() noexcept {
  const std::int64_t now_ns = measure::monotonic_ns();
  if (interface_.empty() || now_ns < next_look_ns_) return;
  next_look_ns_ = now_ns + kLookEvery_ns;
  const net::InterfaceStatus now = net::interface_status(probe_.get(), interface_);
  if (now.state == net::LinkState::kGone || now.index == interface_index_) return;
  auto socket = open_can_socket(now.index, {}, false);
  if (!socket) return;
  socket_ = *std::move(socket);
  interface_index_ = now.index;
}

}  // namespace terracut::can
