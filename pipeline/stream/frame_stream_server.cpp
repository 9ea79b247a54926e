// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/frame_stream_server.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "pipeline/stream/send_buffer.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::stream {
namespace {

constexpr std::size_t kMostPeers = 64;
constexpr std::uint64_t kListenerEvent = kMostPeers;
/// Limits the connections accepted in one round, so that a flood of them does not delay frames.
constexpr int kAcceptsAtOnce = 32;
constexpr std::int64_t kPauseAfterFailure_ns = 1'000'000'000;

/// Makes the system notice within 25 s that a machine is gone without a word, even without frames.
void set_tcp_options(int socket) noexcept {
  const auto set = [socket](int level, int option, int value) {
    ::setsockopt(socket, level, option, &value, sizeof value);
  };
  set(IPPROTO_TCP, TCP_NODELAY,
      1);  // a frame's last bytes must not wait for the first ones' acknowledgement
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, 10);
  set(IPPROTO_TCP, TCP_KEEPINTVL, 5);
  set(IPPROTO_TCP, TCP_KEEPCNT, 3);
}

[[nodiscard]] std::size_t bytes_of(const FrameWireHeader& header) noexcept {
  return sizeof(FrameWireHeader) + std::size_t{header.points} * header.point_bytes;
}

[[nodiscard]] std::size_t point_bytes_of(const FrameStreamConfig& config) noexcept {
  if (config.has_objects) return kPointBytesWithObject;
  return config.has_heights ? kPointBytesWithHeight : sizeof(WirePoint);
}

Status check(const FrameStreamConfig& config) {
  if (config.max_points < 1 || config.max_points > kMostFramePoints) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("frames of up to {} points cannot be streamed; expected 1 to {}",
                            config.max_points, kMostFramePoints));
  }
  if (config.max_peers < 1 || config.max_peers > kMostPeers) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format("a stream for {} readers; expected 1 to {}", config.max_peers, kMostPeers));
  }
  if (config.stall_limit_ns <= 0) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("a stall limit of {} ns; expected more than 0", config.stall_limit_ns));
  }
  return {};
}

}  // namespace

Expected<FrameStreamServer> FrameStreamServer::open(const FrameStreamConfig& config,
                                                    memory::FixedMemory& memory) {
  if (const Status status = check(config); !status) return tl::unexpected(status.error());
  auto listener = ListeningSocket::open(config.address, config.unix_mode);
  if (!listener) return tl::unexpected(listener.error());
  files::OwnedDescriptor events(::epoll_create1(EPOLL_CLOEXEC));
  ::epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = kListenerEvent;
  if (!events || ::epoll_ctl(events.get(), EPOLL_CTL_ADD, listener->descriptor(), &event) != 0) {
    return fail(ErrorCode::kUnreadable, fmt::format("epoll: {}", std::strerror(errno)));
  }
  return FrameStreamServer(config, *std::move(listener), std::move(events), memory);
}

FrameStreamServer::FrameStreamServer(const FrameStreamConfig& config, ListeningSocket listener,
                                     files::OwnedDescriptor events, memory::FixedMemory& memory)
    : config_(config),
      point_bytes_(point_bytes_of(config)),
      listener_(std::move(listener)),
      events_(std::move(events)),
      peers_(config.max_peers),
      slots_(memory.take<Slot>("stream of frames", config.max_peers)) {
  for (Slot& slot : slots_) {
    slot = {memory.take<std::byte>("stream of frames", config.max_points * point_bytes_), 0};
  }
  const bool is_unix = config.address.is_unix();
  const std::size_t wanted = config.send_buffer_bytes > 0
                                 ? config.send_buffer_bytes
                                 : sizeof(FrameWireHeader) + config.max_points * point_bytes_;
  const files::OwnedDescriptor trial(
      ::socket(is_unix ? AF_UNIX : AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  send_buffer_ = send_buffer_grant(wanted, request_send_buffer(trial.get(), wanted));
  // If the kernel has granted no size, TCP chooses its buffer size itself, up to net.ipv4.tcp_wmem.
  if (is_unix || send_buffer_.granted) send_buffer_bytes_ = wanted;
}

bool FrameStreamServer::serve(const LabelledFrame& frame) noexcept {
  work_round();
  if (frame.points.size() > config_.max_points) {
    ++figures_.frames_too_large;
    return false;
  }
  const bool is_sector = (frame.header.flags & kFrameSector) != 0;
  ++(is_sector ? figures_.sectors : figures_.frames);
  hand_out(frame, is_sector);
  if (!is_sector) hand_out({without_points(frame.header), {}}, true);
  return true;
}

void FrameStreamServer::hand_out(const LabelledFrame& message, bool by_sectors) noexcept {
  std::size_t slot = kNoSlot;
  for (Peer& peer : peers_) {
    if (!peer.socket || peer.by_sectors != by_sectors) continue;
    // Sectors may wait in the kernel, whole frames would be old by then.
    if (by_sectors ? peer.slot != kNoSlot : peer.backlog_bytes > 0) {
      ++peer.figures.missed;
      ++(by_sectors ? figures_.sectors_missed : figures_.missed);
      continue;
    }
    if (slot == kNoSlot) {
      slot = free_slot();
      write_points(message.points, message.heights_m, message.objects, point_bytes_,
                   slots_[slot].room);
      ++slots_[slot].holders;  // held here until all readers have been served
    }
    begin(peer, slot, message.header);
  }
  if (slot != kNoSlot) --slots_[slot].holders;
}

void FrameStreamServer::work_round() noexcept {
  handle_events();
  const std::int64_t now_ns = measure::monotonic_ns();
  for (Peer& peer : peers_) {
    if (peer.socket) look_after(peer, now_ns);
  }
  if (listen_again_ns_ != 0 && now_ns >= listen_again_ns_) watch_listener(true);
}

std::size_t FrameStreamServer::peers() const noexcept {
  return static_cast<std::size_t>(std::count_if(
      peers_.begin(), peers_.end(), [](const Peer& peer) { return bool(peer.socket); }));
}

void FrameStreamServer::handle_events() noexcept {
  std::array<::epoll_event, kMostPeers + 1> events;
  const int count = ::epoll_wait(events_.get(), events.data(), static_cast<int>(events.size()), 0);
  bool somebody_knocks = false;
  for (int n = 0; n < count; ++n) {
    const ::epoll_event& event = events[static_cast<std::size_t>(n)];
    if (event.data.u64 == kListenerEvent) {
      somebody_knocks = true;
      continue;
    }
    Peer& peer = peers_[event.data.u64];
    if ((event.events & (EPOLLRDHUP | EPOLLHUP | EPOLLERR)) != 0) {
      part_with(peer, figures_.left);
    } else {
      if ((event.events & EPOLLIN) != 0) hear(peer);
      give(peer);
    }
  }
  // New readers are accepted last: otherwise one could get the place of an old reader that an event
  // above is about.
  if (somebody_knocks) let_in();
}

void FrameStreamServer::let_in() noexcept {
  for (int n = 0; n < kAcceptsAtOnce; ++n) {
    files::OwnedDescriptor socket(
        ::accept4(listener_.descriptor(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (socket) {
      take_in(std::move(socket));
      continue;
    }
    if (errno == EAGAIN || errno == EWOULDBLOCK) return;
    if (errno == EINTR || errno == ECONNABORTED || errno == EPROTO) continue;
    // Descriptors or memory are used up. Stops listening for a while, as the pending connection
    // would keep waking the caller.
    figures_.accept_error = errno;
    ++figures_.accept_failures;
    watch_listener(false);
    return;
  }
}

void FrameStreamServer::take_in(files::OwnedDescriptor socket) noexcept {
  const auto place =
      std::find_if(peers_.begin(), peers_.end(), [](const Peer& peer) { return !peer.socket; });
  if (place == peers_.end()) {
    ++figures_.refused;
    return;
  }
  if (send_buffer_bytes_ > 0) request_send_buffer(socket.get(), send_buffer_bytes_);
  if (!config_.address.is_unix()) set_tcp_options(socket.get());
  Peer& peer = *place;
  peer.socket = std::move(socket);
  peer.backlog_bytes = 0;
  peer.asked_bytes = 0;
  peer.by_sectors = false;
  peer.figures = {.connected = true, .connection = ++figures_.connected};
  watch(peer, EPOLL_CTL_ADD);
}

/// Reads what a reader asks for; nothing that it sends after that is read.
void FrameStreamServer::hear(Peer& peer) noexcept {
  const std::span rest = std::span(peer.asked).subspan(peer.asked_bytes);
  const ::ssize_t got = ::recv(peer.socket.get(), rest.data(), rest.size(), MSG_DONTWAIT);
  if (got <= 0) return;  // an end or an error is an event of its own
  peer.asked_bytes += static_cast<std::size_t>(got);
  if (peer.asked_bytes < peer.asked.size()) return;
  peer.by_sectors = peer.asked == kSectorsPlease;
  watch(peer, EPOLL_CTL_MOD);
}

void FrameStreamServer::watch_listener(bool watch) noexcept {
  ::epoll_event event{};
  event.events = watch ? EPOLLIN : 0U;
  event.data.u64 = kListenerEvent;
  ::epoll_ctl(events_.get(), EPOLL_CTL_MOD, listener_.descriptor(), &event);
  listen_again_ns_ = watch ? 0 : measure::monotonic_ns() + kPauseAfterFailure_ns;
}

void FrameStreamServer::look_after(Peer& peer, std::int64_t now_ns) noexcept {
  if (peer.backlog_bytes == 0) return;
  const std::size_t now_bytes = backlog(peer);
  if (now_bytes < peer.backlog_bytes) {
    peer.progress_ns = now_ns;
  } else if (now_ns - peer.progress_ns > config_.stall_limit_ns) {
    part_with(peer, figures_.stalled);
    return;
  }
  peer.backlog_bytes = now_bytes;
}

std::size_t FrameStreamServer::free_slot() const noexcept {
  const auto slot = std::find_if(slots_.begin(), slots_.end(),
                                 [](const Slot& each) { return each.holders == 0; });
  return static_cast<std::size_t>(slot - slots_.begin());
}

void FrameStreamServer::begin(Peer& peer, std::size_t slot,
                              const FrameWireHeader& header) noexcept {
  peer.header = header;
  peer.header.point_bytes = static_cast<std::uint16_t>(point_bytes_);
  peer.header.missed = static_cast<std::uint32_t>(peer.figures.missed);
  peer.slot = slot;
  ++slots_[slot].holders;
  peer.given_bytes = 0;
  peer.progress_ns = measure::monotonic_ns();
  give(peer);
  if (!peer.socket) return;
  peer.backlog_bytes = backlog(peer);
  if (peer.slot != kNoSlot) watch(peer, EPOLL_CTL_MOD);
}

void FrameStreamServer::give(Peer& peer) noexcept {
  if (!peer.socket || peer.slot == kNoSlot) return;
  const std::size_t all_bytes = bytes_of(peer.header);
  while (peer.given_bytes < all_bytes) {
    const std::span header = std::as_writable_bytes(std::span(&peer.header, 1));
    const std::span points =
        slots_[peer.slot].room.first(peer.header.points * std::size_t{peer.header.point_bytes});
    const std::size_t of_header = std::min(peer.given_bytes, header.size());
    const std::size_t of_points = peer.given_bytes - of_header;
    std::array<::iovec, 2> parts{{{header.data() + of_header, header.size() - of_header},
                                  {points.data() + of_points, points.size() - of_points}}};
    ::msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = parts.size();
    // Without MSG_NOSIGNAL a reader that closes its connection would end this process by SIGPIPE.
    const ::ssize_t given = ::sendmsg(peer.socket.get(), &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (given < 0) {
      if (errno == EINTR) continue;
      if (errno == EAGAIN || errno == EWOULDBLOCK) return;
      part_with(peer, figures_.left);
      return;
    }
    peer.given_bytes += static_cast<std::size_t>(given);
    figures_.bytes += static_cast<std::uint64_t>(given);
  }
  release(peer);
  ++peer.figures.sent;
  ++figures_.sent;
  watch(peer, EPOLL_CTL_MOD);
}

void FrameStreamServer::release(Peer& peer) noexcept {
  --slots_[peer.slot].holders;
  peer.slot = kNoSlot;
}

void FrameStreamServer::part_with(Peer& peer, std::uint64_t& counter) noexcept {
  if (!peer.socket) return;
  ++counter;
  if (peer.slot != kNoSlot) {
    ++figures_.cut_short;
    release(peer);
  }
  // Ends both the registration and the connection itself: a child process may hold copies of the
  // descriptor.
  watch(peer, EPOLL_CTL_DEL);
  ::shutdown(peer.socket.get(), SHUT_RDWR);
  peer.socket.close();
  peer.backlog_bytes = 0;
  peer.figures.connected = false;
}

/// Watches a connection: its end; room in it, while a message is being sent; and what the reader
/// asks for, until that is known.
void FrameStreamServer::watch(Peer& peer, int operation) noexcept {
  const bool is_heard = config_.serves_sectors && peer.asked_bytes < peer.asked.size();
  ::epoll_event event{};
  event.events = EPOLLRDHUP | (peer.slot != kNoSlot ? EPOLLOUT : 0U) | (is_heard ? EPOLLIN : 0U);
  event.data.u64 = static_cast<std::uint64_t>(&peer - peers_.data());
  ::epoll_ctl(events_.get(), operation, peer.socket.get(), &event);
}

std::size_t FrameStreamServer::backlog(const Peer& peer) const noexcept {
  const std::size_t ours = peer.slot == kNoSlot ? 0 : bytes_of(peer.header) - peer.given_bytes;
  return ours + bytes_waiting_in(peer.socket.get(), config_.address.is_unix());
}

}  // namespace terracut::stream
