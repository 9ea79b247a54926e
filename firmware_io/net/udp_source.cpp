// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/udp_source.hpp"

#include <fmt/format.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::net {
namespace {

static_assert(DatagramSource<UdpSource>);

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kLookEvery_ns = kSecond_ns / 2;

template <class Value>
bool set_option(int socket, int level, int option, const Value& value) noexcept {
  return ::setsockopt(socket, level, option, &value, sizeof value) == 0;
}

bool join(int socket, const UdpSourceConfig& config, int interface_index) noexcept {
  ip_mreqn request{};
  request.imr_multiaddr.s_addr = htonl(*config.multicast_group);
  request.imr_ifindex = interface_index;
  return set_option(socket, IPPROTO_IP, IP_ADD_MEMBERSHIP, request);
}

Status check(const UdpSourceConfig& config) {
  if (config.multicast_group && !is_multicast(*config.multicast_group)) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{} is no multicast group; expected 224.0.0.0 to 239.255.255.255",
                            ipv4_text(*config.multicast_group)));
  }
  if (is_multicast(config.bind.address)) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{} is a multicast group, not an address of this machine; bind to any "
                            "address and name it as multicast_group",
                            ipv4_text(config.bind.address)));
  }
  return {};
}

std::string reason_of(int error_number) {
  return std::strerror(error_number);
}

}  // namespace

Expected<UdpSource> UdpSource::open(UdpSourceConfig config, memory::FixedMemory& memory) {
  if (Status valid = check(config); !valid) return tl::unexpected(valid.error());
  auto wake = threads::WakeEvent::make();
  if (!wake) return tl::unexpected(wake.error());
  files::OwnedDescriptor probe(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!probe) return tl::unexpected(explain(config, {Step::kSocket, errno}));
  InterfaceStatus interface;
  if (!config.interface.empty()) {
    interface = interface_status(probe.get(), config.interface);
    if (interface.state == LinkState::kGone) {
      return tl::unexpected(no_such_interface(config.interface));
    }
  }
  auto socket = open_socket(config, interface);
  if (!socket) return tl::unexpected(explain(config, socket.error()));

  sockaddr_in local{};
  socklen_t size = sizeof local;
  ::getsockname(socket->descriptor.get(), reinterpret_cast<sockaddr*>(&local), &size);
  config.bind = endpoint_of(local);

  UdpSource source(std::move(config), *std::move(wake), std::move(probe), memory);
  source.socket_ = *std::move(socket);
  source.note_shortfalls();
  if (!source.config_.interface.empty()) source.link_ = interface.state;
  return source;
}

UdpSource::UdpSource(UdpSourceConfig config, threads::WakeEvent wake, files::OwnedDescriptor probe,
                     memory::FixedMemory& memory)
    : config_(std::move(config)),
      wake_(std::move(wake)),
      probe_(std::move(probe)),
      bytes_(memory.take<std::uint8_t>("udp source", config_.batch * config_.slot_bytes)),
      messages_(memory.take<::mmsghdr>("udp source", config_.batch)),
      vectors_(memory.take<::iovec>("udp source", config_.batch)),
      senders_(memory.take<::sockaddr_in>("udp source", config_.batch)),
      controls_(memory.take<Control>("udp source", config_.batch)),
      datagrams_(memory.take<packet::Datagram>("udp source", config_.batch)) {
  for (std::size_t slot = 0; slot < config_.batch; ++slot) {
    vectors_[slot] = {bytes_.data() + slot * config_.slot_bytes, config_.slot_bytes};
    ::msghdr& header = messages_[slot].msg_hdr;
    header.msg_name = &senders_[slot];
    header.msg_iov = &vectors_[slot];
    header.msg_iovlen = 1;
    header.msg_control = &controls_[slot];
  }
  prepare(config_.batch);
}

tl::expected<UdpSource::Socket, UdpSource::Failure> UdpSource::open_socket(
    const UdpSourceConfig& config, const InterfaceStatus& interface) noexcept {
  const auto failed = [](Step step) { return tl::unexpected(Failure{step, errno}); };
  Socket socket;
  socket.descriptor =
      files::OwnedDescriptor(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket.descriptor) return failed(Step::kSocket);
  const int descriptor = socket.descriptor.get();
  const int on = 1, off = 0;

  // All options that decide what the socket receives are set before bind(), which starts reception.
  socket.buffer = request_receive_buffer(descriptor, config.receive_buffer_bytes);
  if (!set_option(descriptor, SOL_SOCKET, SO_TIMESTAMPNS, on) ||
      !set_option(descriptor, SOL_SOCKET, SO_RXQ_OVFL, on) ||
      !set_option(descriptor, IPPROTO_IP, IP_PKTINFO, on)) {
    return failed(Step::kSocket);
  }
  // Without this option the socket receives every multicast group that any program of this machine
  // has joined.
  set_option(descriptor, IPPROTO_IP, IP_MULTICAST_ALL, off);
  if (config.share_port) set_option(descriptor, SOL_SOCKET, SO_REUSEADDR, on);

  if (!config.interface.empty()) {
    socket.interface_index = interface.index;
    socket.bound_to_interface =
        ::setsockopt(descriptor, SOL_SOCKET, SO_BINDTODEVICE, config.interface.c_str(),
                     static_cast<socklen_t>(config.interface.size() + 1)) == 0;
    // A process without the right to bind to an interface checks each datagram's interface
    // (in_pktinfo). Binding to the interface's address instead would shut out broadcasts.
    if (!socket.bound_to_interface && errno != EPERM) return failed(Step::kInterface);
  }
  const sockaddr_in address = socket_address(config.bind);
  if (::bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return failed(Step::kBind);
  }
  if (config.multicast_group && !join(descriptor, config, socket.interface_index)) {
    return failed(Step::kJoin);
  }
  return socket;
}

Error UdpSource::explain(const UdpSourceConfig& config, const Failure& failure) {
  const std::string reason = reason_of(failure.error_number);
  const std::string where = to_string(config.bind);
  switch (failure.step) {
    case Step::kSocket:
      break;
    case Step::kInterface:
      if (failure.error_number == ENODEV) return no_such_interface(config.interface);
      return {ErrorCode::kUnreadable, fmt::format("interface '{}': {}", config.interface, reason)};
    case Step::kBind:
      if (failure.error_number == EADDRINUSE) {
        return {ErrorCode::kUnreadable,
                fmt::format("UDP port {0} is in use by another socket; `ss -ulnp sport = :{0}` "
                            "names the process. Stop it, or, for broadcast or multicast sensors, "
                            "give both share_port",
                            config.bind.port)};
      }
      if (failure.error_number == EADDRNOTAVAIL) {
        return {ErrorCode::kNotFound,
                fmt::format("{} is no address of this machine; expected one that `ip -4 addr` "
                            "lists, or none for all of them",
                            ipv4_text(config.bind.address))};
      }
      if (failure.error_number == EACCES) {
        return {ErrorCode::kUnreadable,
                fmt::format("UDP port {}: {}; ports below net.ipv4.ip_unprivileged_port_start need "
                            "CAP_NET_BIND_SERVICE",
                            config.bind.port, reason)};
      }
      return {ErrorCode::kUnreadable, fmt::format("{}: {}", where, reason)};
    case Step::kJoin:
      return {ErrorCode::kUnreadable,
              fmt::format("cannot join the multicast group {}: {}; name the sensor's interface, or "
                          "add a route to the group (`ip route add 224.0.0.0/4 dev NAME`)",
                          ipv4_text(*config.multicast_group), reason)};
  }
  return {ErrorCode::kUnreadable, fmt::format("UDP socket for {}: {}", where, reason)};
}

void UdpSource::note_shortfalls() {
  if (std::string text = describe_shortfall(socket_.buffer); !text.empty()) {
    warnings_.push_back(std::move(text));
  }
  if (!config_.interface.empty() && !socket_.bound_to_interface) {
    warnings_.push_back(
        fmt::format("not permitted to bind to interface '{}' (needs CAP_NET_RAW on this system): "
                    "datagrams of other interfaces take room in the receive buffer before they are "
                    "left out",
                    config_.interface));
  }
}

std::span<const packet::Datagram> UdpSource::receive(std::int64_t timeout_ns) noexcept {
  const std::int64_t begun_ns = measure::monotonic_ns();
  const std::int64_t deadline_ns =
      begun_ns + std::clamp<std::int64_t>(timeout_ns, 0, INT64_MAX - begun_ns);
  for (;;) {
    if (const std::size_t count = read_batch(); count > 0) {
      // The socket was empty when the link was found down, so the link has come up since.
      if (link_ != LinkState::kUnknown) link_ = LinkState::kUp;
      return datagrams_.first(count);
    }
    const std::int64_t now_ns = measure::monotonic_ns();
    look_after(now_ns);
    if (now_ns >= deadline_ns) return {};
    const std::int64_t until_ns = std::min(deadline_ns, next_look_ns_);
    if (wake_.wait(socket_.descriptor.get(), until_ns - now_ns)) return {};
  }
}

/// Reads the datagrams that are ready, at most a batch; moves those to deliver to the front of
/// datagrams_.
std::size_t UdpSource::read_batch() noexcept {
  if (!socket_.descriptor) return 0;
  int error_number = 0;
  const int taken = threads::trusted_call([&]() noexcept {  // MSG_DONTWAIT
    const int result = ::recvmmsg(socket_.descriptor.get(), messages_.data(),
                                  static_cast<unsigned>(messages_.size()), MSG_DONTWAIT, nullptr);
    error_number = errno;
    return result;
  });
  if (taken < 0) {
    if (error_number != EAGAIN && error_number != EINTR) ++counters_.receive_errors;
    return 0;
  }
  const auto count = static_cast<std::size_t>(taken);
  std::size_t kept = 0;
  for (std::size_t slot = 0; slot < count; ++slot) {
    if (take(slot, datagrams_[kept])) ++kept;
  }
  prepare(count);
  counters_.received += count;
  counters_.delivered += kept;
  // The batch was full: more datagrams may be waiting, and the kernel may have dropped others since
  // it counted the drops of these.
  if (count == messages_.size()) refresh_drops();
  return kept;
}

/// Converts the datagram in `slot`; false if it is only counted, not delivered.
bool UdpSource::take(std::size_t slot, packet::Datagram& datagram) noexcept {
  ::msghdr& header = messages_[slot].msg_hdr;
  const Ipv4Endpoint sender = endpoint_of(senders_[slot]);
  int interface_index = 0;
  bool stamped = false;
  datagram = {};
  for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
    if (part->cmsg_level == SOL_SOCKET && part->cmsg_type == SCM_TIMESTAMPNS) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
      datagram.stamp_ns = std::int64_t{stamp.tv_sec} * kSecond_ns + stamp.tv_nsec;
      stamped = true;
    } else if (part->cmsg_level == SOL_SOCKET && part->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t dropped = 0;
      std::memcpy(&dropped, CMSG_DATA(part), sizeof dropped);
      counters_.kernel_drops += drops_.advance_to(dropped);
    } else if (part->cmsg_level == IPPROTO_IP && part->cmsg_type == IP_PKTINFO) {
      in_pktinfo info{};
      std::memcpy(&info, CMSG_DATA(part), sizeof info);
      datagram.destination_address = ntohl(info.ipi_addr.s_addr);
      interface_index = info.ipi_ifindex;
    }
  }
  if (socket_.interface_index != 0 && !socket_.bound_to_interface &&
      interface_index != socket_.interface_index) {
    ++counters_.other_interface;
    return false;
  }
  if (config_.sender && !config_.sender->has_sent(sender.address, sender.port)) {
    ++counters_.foreign;
    return false;
  }
  if ((header.msg_flags & MSG_TRUNC) != 0) {
    ++counters_.truncated;
    return false;
  }
  if (!stamped) {
    ++counters_.unstamped;
    datagram.stamp_ns = measure::realtime_ns();
  }
  datagram.payload = bytes_.subspan(slot * config_.slot_bytes, messages_[slot].msg_len);
  datagram.source_address = sender.address;
  datagram.source_port = sender.port;
  datagram.destination_port = config_.bind.port;
  return true;
}

/// Restores the lengths offered to the kernel, which it overwrites with those used.
void UdpSource::prepare(std::size_t slots) noexcept {
  for (::mmsghdr& message : messages_.first(slots)) {
    message.msg_hdr.msg_namelen = sizeof(sockaddr_in);
    message.msg_hdr.msg_controllen = Control::kBytes;
    message.msg_hdr.msg_flags = 0;
  }
}

void UdpSource::refresh_drops() noexcept {
  if (!socket_.descriptor) return;
  std::array<std::uint32_t, SK_MEMINFO_VARS> facts{};
  socklen_t size = sizeof facts;
  const bool known = threads::trusted_call([&]() noexcept {  // only copies counters
    return ::getsockopt(socket_.descriptor.get(), SOL_SOCKET, SO_MEMINFO, facts.data(), &size) == 0;
  });
  if (known && size > SK_MEMINFO_DROPS * sizeof facts[0]) {
    counters_.kernel_drops += drops_.advance_to(facts[SK_MEMINFO_DROPS]);
  }
}

/// Looks after the multicast group and the interface: only when nothing came, and not often.
void UdpSource::look_after(std::int64_t now_ns) noexcept {
  if (now_ns < next_look_ns_) return;
  next_look_ns_ = now_ns + kLookEvery_ns;
  refresh_drops();
  if (!config_.interface.empty()) look_after_interface();
  // The kernel forgets the membership when the interface disappears; joining again while it holds
  // does nothing.
  if (config_.multicast_group && socket_.descriptor) {
    threads::trusted_call([this]() noexcept {  // may take its time: no datagram is waiting
      join(socket_.descriptor.get(), config_, socket_.interface_index);
    });
  }
}

/// Opens a new socket for an interface that came back: the old socket stays tied to the old
/// interface, whatever its name. The old one must be closed first, as it holds the port.
void UdpSource::look_after_interface() noexcept {
  const InterfaceStatus now = interface_status(probe_.get(), config_.interface);
  if (now.state != LinkState::kUp && link_ == LinkState::kUp) ++counters_.link_losses;
  link_ = now.state;
  if (now.state == LinkState::kGone) return;
  if (socket_.descriptor && now.index == socket_.interface_index) return;
  refresh_drops();
  const bool opened = threads::trusted_call([&]() noexcept {  // may take its time as well
    socket_.descriptor.close();
    auto socket = open_socket(config_, now);
    if (socket) socket_ = *std::move(socket);
    return socket.has_value();
  });
  if (!opened) return;  // its address or route is not back yet; the next look tries again
  drops_.restart();
  ++counters_.reopened;
}

}  // namespace terracut::net
