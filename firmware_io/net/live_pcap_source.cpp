// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/live_pcap_source.hpp"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "firmware_io/net/network_interface.hpp"
#include "firmware_io/packet/udp_frame.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::net {
namespace {

static_assert(DatagramSource<LivePcapSource>);

constexpr std::int64_t kLookEvery_ns = 500'000'000;
constexpr int kBufferBytes = 8 << 20;  ///< Size of the kernel's ring.
/// Room for the link-layer header, VLAN tags, the longest IP header and the UDP header.
constexpr std::size_t kMostHeaderBytes = 128;

Error refused(const std::string& interface, int result, ::pcap* handle) {
  switch (result) {
    case PCAP_ERROR_NO_SUCH_DEVICE:
      return no_such_interface(interface);
    case PCAP_ERROR_PERM_DENIED:
    case PCAP_ERROR_PROMISC_PERM_DENIED:
      return {ErrorCode::kUnreadable,
              fmt::format("not permitted to listen on interface '{}': that needs CAP_NET_RAW; give "
                          "it to the program with `setcap cap_net_raw+ep PROGRAM`, or receive by "
                          "UDP, which needs none",
                          interface)};
    case PCAP_ERROR_IFACE_NOT_UP:
      return {
          ErrorCode::kUnreadable,
          fmt::format("interface '{0}' is down; bring it up with `ip link set {0} up`", interface)};
    default:
      return {ErrorCode::kUnreadable,
              fmt::format("interface '{}': {} ({})", interface, ::pcap_statustostr(result),
                          ::pcap_geterr(handle))};
  }
}

/// Returns the filter program. A VLAN tag shifts the IP header, so tagged datagrams need a term of
/// their own, which must be the last one.
std::string filter_of(const LivePcapConfig& config) {
  const std::string udp = config.port ? fmt::format("udp dst port {}", *config.port) : "udp";
  return fmt::format("({0}) or (vlan and {0})", udp);
}

Status set_filter(::pcap* handle, const LivePcapConfig& config) {
  bpf_program program{};
  std::string text = filter_of(config);
  // libpcap refuses the VLAN term for raw IP links, because they have no VLANs.
  if (::pcap_compile(handle, &program, text.c_str(), 1, PCAP_NETMASK_UNKNOWN) != 0) {
    text = text.substr(0, text.find(" or "));
    if (::pcap_compile(handle, &program, text.c_str(), 1, PCAP_NETMASK_UNKNOWN) != 0) {
      return fail(ErrorCode::kUnsupported,
                  fmt::format("interface '{}': cannot filter '{}': {}", config.interface, text,
                              ::pcap_geterr(handle)));
    }
  }
  const int result = ::pcap_setfilter(handle, &program);
  ::pcap_freecode(&program);
  if (result != 0) return tl::unexpected(refused(config.interface, result, handle));
  return {};
}

}  // namespace

void LivePcapSource::Close::operator()(::pcap* handle) const noexcept {
  ::pcap_close(handle);
}

Expected<LivePcapSource> LivePcapSource::open(LivePcapConfig config, memory::FixedMemory& memory) {
  auto wake = threads::WakeEvent::make();
  if (!wake) return tl::unexpected(wake.error());
  files::OwnedDescriptor probe(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!probe) {
    return fail(ErrorCode::kUnreadable, fmt::format("UDP socket: {}", std::strerror(errno)));
  }
  if (interface_status(probe.get(), config.interface).state == LinkState::kGone) {
    return tl::unexpected(no_such_interface(config.interface));
  }
  auto handle = activate(config);
  if (!handle) return tl::unexpected(handle.error());
  LivePcapSource source(std::move(config), *std::move(wake), std::move(probe), memory);
  source.adopt(*std::move(handle));
  return source;
}

LivePcapSource::LivePcapSource(LivePcapConfig config, threads::WakeEvent wake,
                               files::OwnedDescriptor probe, memory::FixedMemory& memory)
    : config_(std::move(config)),
      wake_(std::move(wake)),
      probe_(std::move(probe)),
      bytes_(memory.take<std::uint8_t>("pcap source", config_.batch * config_.slot_bytes)),
      datagrams_(memory.take<packet::Datagram>("pcap source", config_.batch)) {}

Expected<LivePcapSource::Handle> LivePcapSource::activate(const LivePcapConfig& config) {
  std::array<char, PCAP_ERRBUF_SIZE> message{};
  Handle handle(::pcap_create(config.interface.c_str(), message.data()));
  if (!handle) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("interface '{}': {}", config.interface, message.data()));
  }
  ::pcap_set_snaplen(handle.get(), static_cast<int>(config.slot_bytes + kMostHeaderBytes));
  ::pcap_set_immediate_mode(handle.get(), 1);  // else packets are delayed to share a wake-up
  ::pcap_set_buffer_size(handle.get(), kBufferBytes);
  ::pcap_set_tstamp_precision(handle.get(), PCAP_TSTAMP_PRECISION_NANO);
  if (const int result = ::pcap_activate(handle.get()); result < 0) {
    return tl::unexpected(refused(config.interface, result, handle.get()));
  }
  const int link_type = ::pcap_datalink(handle.get());
  if (!packet::is_supported_link_type(link_type)) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("interface '{}': link layer {} carries no UDP that terracut reads",
                            config.interface, link_type));
  }
  if (Status filtered = set_filter(handle.get(), config); !filtered) {
    return tl::unexpected(filtered.error());
  }
  // This machine's own packets do not come from a sensor. If the direction is unknown, only the
  // port and the sender decide.
  static_cast<void>(::pcap_setdirection(handle.get(), PCAP_D_IN));
  if (const int result = ::pcap_setnonblock(handle.get(), 1, message.data()); result != 0) {
    return tl::unexpected(refused(config.interface, result, handle.get()));
  }
  return handle;
}

void LivePcapSource::adopt(Handle handle) noexcept {
  handle_ = std::move(handle);
  descriptor_ = ::pcap_get_selectable_fd(handle_.get());
  link_type_ = ::pcap_datalink(handle_.get());
  const bool nanoseconds = ::pcap_get_tstamp_precision(handle_.get()) == PCAP_TSTAMP_PRECISION_NANO;
  stamp_unit_ns_ = nanoseconds ? 1 : 1000;
  const InterfaceStatus interface = interface_status(probe_.get(), config_.interface);
  interface_index_ = interface.index;
  link_ = interface.state;
  drops_.restart();
}

std::span<const packet::Datagram> LivePcapSource::receive(std::int64_t timeout_ns) noexcept {
  const std::int64_t begun_ns = measure::monotonic_ns();
  const std::int64_t deadline_ns =
      begun_ns + std::clamp<std::int64_t>(timeout_ns, 0, INT64_MAX - begun_ns);
  for (;;) {
    if (const std::size_t count = read_batch(); count > 0) {
      // The socket was empty when the link was found down, so the link has come up since.
      link_ = LinkState::kUp;
      return datagrams_.first(count);
    }
    const std::int64_t now_ns = measure::monotonic_ns();
    look_after(now_ns);
    if (now_ns >= deadline_ns) return {};
    const std::int64_t until_ns = std::min(deadline_ns, next_look_ns_);
    if (wake_.wait(handle_ ? descriptor_ : -1, until_ns - now_ns)) return {};
  }
}

/// Reads the frames that are ready and copies their payloads, because libpcap shows frames one by
/// one and reuses their memory.
std::size_t LivePcapSource::read_batch() noexcept {
  if (!handle_) return 0;
  kept_ = 0;
  const auto on_frame = [](unsigned char* self, const pcap_pkthdr* header,
                           const unsigned char* data) {
    auto& source = *reinterpret_cast<LivePcapSource*>(self);
    source.take({data, header->caplen}, std::int64_t{header->ts.tv_sec} * 1'000'000'000 +
                                            header->ts.tv_usec * source.stamp_unit_ns_);
  };
  // pcap_setnonblock() makes this call return at once. Its buffers were allocated by
  // pcap_activate().
  const int result = threads::trusted_call([&]() noexcept {
    return ::pcap_dispatch(handle_.get(), static_cast<int>(config_.batch), on_frame,
                           reinterpret_cast<unsigned char*>(this));
  });
  if (result == static_cast<int>(config_.batch)) refresh_drops();
  if (result < 0) {
    ++counters_.receive_errors;
    refresh_drops();
    // This handle delivers no more packets; look_after() opens the interface again.
    threads::trusted_call([this]() noexcept { handle_.reset(); });
  }
  counters_.delivered += kept_;
  return kept_;
}

void LivePcapSource::take(std::span<const std::uint8_t> frame, std::int64_t stamp_ns) noexcept {
  ++counters_.received;
  const auto parsed = packet::parse_udp_frame(link_type_, frame, stamp_ns);
  if (!parsed) {
    ++counters_.no_datagram;
  } else if (config_.sender &&
             !config_.sender->has_sent(parsed->source_address, parsed->source_port)) {
    ++counters_.foreign;
  } else if (parsed->payload.size() > config_.slot_bytes) {
    ++counters_.truncated;
  } else {
    const auto slot = bytes_.subspan(kept_ * config_.slot_bytes, parsed->payload.size());
    std::copy(parsed->payload.begin(), parsed->payload.end(), slot.begin());
    datagrams_[kept_] = *parsed;
    datagrams_[kept_].payload = slot;
    ++kept_;
  }
}

void LivePcapSource::refresh_drops() noexcept {
  pcap_stat stats{};
  const bool known = threads::trusted_call([&]() noexcept {  // only copies counters
    return handle_ && ::pcap_stats(handle_.get(), &stats) == 0;
  });
  if (known) {
    counters_.kernel_drops += drops_.advance_to(stats.ps_drop);
  }
}

void LivePcapSource::look_after(std::int64_t now_ns) noexcept {
  if (now_ns < next_look_ns_) return;
  next_look_ns_ = now_ns + kLookEvery_ns;
  refresh_drops();
  const InterfaceStatus now = interface_status(probe_.get(), config_.interface);
  if (now.state != LinkState::kUp && link_ == LinkState::kUp) ++counters_.link_losses;
  link_ = now.state;
  if (now.state == LinkState::kGone) return;
  if (handle_ && now.index == interface_index_) return;
  // Opening the interface makes libpcap allocate memory. This delays nothing: no packet can arrive
  // before the interface is open.
  threads::trusted_call([this]() noexcept {
    handle_.reset();
    if (auto handle = activate(config_)) {
      adopt(*std::move(handle));
      ++counters_.reopened;
    }
  });
}

}  // namespace terracut::net
