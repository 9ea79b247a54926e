// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/can/socketcan_source.hpp"

#include <fmt/format.h>
#include <linux/can/error.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "firmware_io/can/can_socket.hpp"
#include "firmware_io/net/receive_buffer.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::can {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kLookEvery_ns = kSecond_ns / 2;

Status check(const SocketCanConfig& config) {
  if (config.ids.empty() || config.ids.size() > kMostCanFilters) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{} CAN ids: expected 1 to {}", config.ids.size(), kMostCanFilters));
  }
  const auto wrong = std::ranges::find_if_not(config.ids, &CanId::valid);
  if (wrong != config.ids.end()) {
    return fail(ErrorCode::kInvalidArgument, fmt::format("CAN id {:#x} has more than {} bits",
                                                         wrong->number, wrong->extended ? 29 : 11));
  }
  return {};
}

}  // namespace

Expected<SocketCanSource> SocketCanSource::open(SocketCanConfig config,
                                                memory::FixedMemory& memory) {
  if (Status valid = check(config); !valid) return tl::unexpected(valid.error());
  files::OwnedDescriptor probe(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const net::InterfaceStatus interface = net::interface_status(probe.get(), config.interface);
  files::OwnedDescriptor descriptor;
  if (interface.state != net::LinkState::kGone) {
    auto socket = open_can_socket(interface.index, config.ids, true);
    if (!socket) return tl::unexpected(explain(socket.error(), config.interface));
    descriptor = *std::move(socket);
  } else if (!config.wait_for_interface) {
    return tl::unexpected(net::no_such_interface(config.interface));
  }
  auto source = adopt(std::move(descriptor), std::move(config), memory);
  if (!source) return source;
  source->probe_ = std::move(probe);
  source->interface_index_ = interface.index;
  source->link_ = interface.state;
  return source;
}

Expected<SocketCanSource> SocketCanSource::adopt(files::OwnedDescriptor descriptor,
                                                 SocketCanConfig config,
                                                 memory::FixedMemory& memory) {
  if (Status valid = check(config); !valid) return tl::unexpected(valid.error());
  auto wake = threads::WakeEvent::make();
  if (!wake) return tl::unexpected(wake.error());
  SocketCanSource source(std::move(config), *std::move(wake), memory);
  if (!descriptor) return source;
  (void)net::request_receive_buffer(descriptor.get(), source.config_.receive_buffer_bytes);
  const int on = 1;
  ::setsockopt(descriptor.get(), SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  source.socket_ = std::move(descriptor);
  return source;
}

SocketCanSource::SocketCanSource(SocketCanConfig config, threads::WakeEvent wake,
                                 memory::FixedMemory& memory)
    : config_(std::move(config)),
      wake_(std::move(wake)),
      wires_(memory.take<Wire>("can source", config_.batch)),
      messages_(memory.take<::mmsghdr>("can source", config_.batch)),
      vectors_(memory.take<::iovec>("can source", config_.batch)),
      controls_(memory.take<Control>("can source", config_.batch)),
      frames_(memory.take<CanFrame>("can source", config_.batch)) {
  for (std::size_t slot = 0; slot < config_.batch; ++slot) {
    vectors_[slot] = {wires_[slot].data(), wires_[slot].size()};
    ::msghdr& header = messages_[slot].msg_hdr;
    header.msg_iov = &vectors_[slot];
    header.msg_iovlen = 1;
    header.msg_control = &controls_[slot];
  }
  prepare(config_.batch);
}

std::span<const CanFrame> SocketCanSource::receive(std::int64_t timeout_ns) noexcept {
  const std::int64_t begun_ns = measure::monotonic_ns();
  const std::int64_t deadline_ns =
      begun_ns + std::clamp<std::int64_t>(timeout_ns, 0, INT64_MAX - begun_ns);
  for (;;) {
    if (const std::size_t count = read_batch(); count > 0) {
      // The socket was empty when the link was found down, so the link has come up since.
      if (link_ != net::LinkState::kUnknown) link_ = net::LinkState::kUp;
      return frames_.first(count);
    }
    const std::int64_t now_ns = measure::monotonic_ns();
    look_after_interface(now_ns);
    if (now_ns >= deadline_ns) return {};
    const std::int64_t until_ns = std::min(deadline_ns, next_look_ns_);
    if (wake_.wait(socket_.get(), until_ns - now_ns)) return {};
  }
}

/// Reads the frames that are ready, at most a batch; moves those to deliver to the front of
/// frames_.
std::size_t SocketCanSource::read_batch() noexcept {
  if (!socket_) return 0;
  int error_number = 0;
  const int taken = threads::trusted_call([&]() noexcept {  // MSG_DONTWAIT
    const int result = ::recvmmsg(socket_.get(), messages_.data(),
                                  static_cast<unsigned>(messages_.size()), MSG_DONTWAIT, nullptr);
    error_number = errno;
    return result;
  });
  if (taken < 0) {
    // The socket reports a lost interface once; look_after_interface() counts it.
    const bool link_is_the_reason = error_number == ENETDOWN || error_number == ENODEV;
    if (link_is_the_reason) next_look_ns_ = 0;
    if (!link_is_the_reason && error_number != EAGAIN && error_number != EINTR) {
      ++counters_.receive_errors;
    }
    return 0;
  }
  const auto count = static_cast<std::size_t>(taken);
  std::size_t kept = 0;
  for (std::size_t slot = 0; slot < count; ++slot) {
    if (take(slot, frames_[kept])) ++kept;
  }
  prepare(count);
  counters_.received += count;
  counters_.delivered += kept;
  return kept;
}

/// Converts the frame in `slot`; false if it is only counted, not delivered.
bool SocketCanSource::take(std::size_t slot, CanFrame& frame) noexcept {
  ::msghdr& header = messages_[slot].msg_hdr;
  std::int64_t stamp_ns = 0;
  bool stamped = false;
  for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
    if (part->cmsg_level != SOL_SOCKET) continue;
    if (part->cmsg_type == SCM_TIMESTAMPNS) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
      stamp_ns = std::int64_t{stamp.tv_sec} * kSecond_ns + stamp.tv_nsec;
      stamped = true;
    } else if (part->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t dropped = 0;
      std::memcpy(&dropped, CMSG_DATA(part), sizeof dropped);
      counters_.kernel_drops += drops_.advance_to(dropped);
    }
  }
  const auto parsed =
      parse_can_wire(std::span(wires_[slot]).first(messages_[slot].msg_len), CanIdOrder::kNative);
  if (!parsed || (header.msg_flags & MSG_TRUNC) != 0) {
    ++counters_.malformed;
    return false;
  }
  if (parsed->error) {
    note_error_frame(*parsed);
    return false;
  }
  if (!stamped) {
    ++counters_.unstamped;
    stamp_ns = measure::realtime_ns();
  }
  bus_off_ = false;  // the controller is on the bus again
  frame = *parsed;
  frame.stamp_ns = stamp_ns;
  return true;
}

void SocketCanSource::note_error_frame(const CanFrame& frame) noexcept {
  ++counters_.error_frames;
  if ((frame.id.number & CAN_ERR_RESTARTED) != 0) {
    ++counters_.restarts;
    bus_off_ = false;
  }
  if ((frame.id.number & CAN_ERR_BUSOFF) != 0) {
    ++counters_.bus_off;
    bus_off_ = true;
  }
}

/// Restores the lengths offered to the kernel, which it overwrites with those used.
void SocketCanSource::prepare(std::size_t slots) noexcept {
  for (::mmsghdr& message : messages_.first(slots)) {
    message.msg_hdr.msg_controllen = Control::kBytes;
    message.msg_hdr.msg_flags = 0;
  }
}

/// Opens a new socket for an interface that came back: the old socket stays tied to the old
/// interface, whatever its name. Looks only when nothing came, and at most every kLookEvery_ns.
void SocketCanSource::look_after_interface(std::int64_t now_ns) noexcept {
  if (now_ns < next_look_ns_) return;
  next_look_ns_ = now_ns + kLookEvery_ns;
  if (!probe_) return;
  const net::InterfaceStatus now = net::interface_status(probe_.get(), config_.interface);
  if (now.state != net::LinkState::kUp && link_ == net::LinkState::kUp) ++counters_.link_losses;
  link_ = now.state;
  if (now.state == net::LinkState::kGone) return;
  if (socket_ && now.index == interface_index_) return;
  const bool opened =
      threads::trusted_call([&]() noexcept {  // may take its time: no frame is waiting
        auto socket = open_can_socket(now.index, config_.ids, true);
        if (!socket) return false;
        (void)net::request_receive_buffer(socket->get(), config_.receive_buffer_bytes);
        socket_ = *std::move(socket);
        return true;
      });
  if (!opened) {  // the next look tries again
    ++counters_.receive_errors;
    return;
  }
  const bool again = interface_index_ != 0;
  interface_index_ = now.index;
  drops_.restart();
  if (again) ++counters_.reopened;
}

}  // namespace terracut::can
