// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/udp_frame.hpp"

namespace terracut::packet {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Rejected = tl::unexpected<FrameReject>;

constexpr std::uint16_t kEtherTypeIpv4 = 0x0800;
constexpr std::uint16_t kEtherTypeIpv6 = 0x86DD;
constexpr std::uint8_t kProtocolUdp = 17;
constexpr std::size_t kUdpHeaderBytes = 8;

// DLT_ numbers of pcap/dlt.h, spelled out here so that the parser does not need libpcap.
constexpr int kNull = 0;
constexpr int kEthernet = 1;
constexpr int kRawLinux = 12;
constexpr int kRawOpenBsd = 14;
constexpr int kRawInFiles = 101;
constexpr int kLoop = 108;
constexpr int kCookedV1 = 113;
constexpr int kIpv4 = 228;
constexpr int kCookedV2 = 276;

constexpr std::uint16_t big_u16(Bytes bytes, std::size_t at) noexcept {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

constexpr std::uint32_t big_u32(Bytes bytes, std::size_t at) noexcept {
  return std::uint32_t{big_u16(bytes, at)} << 16 | big_u16(bytes, at + 2);
}

constexpr bool is_vlan_tag(std::uint16_t ether_type) noexcept {
  return ether_type == 0x8100 || ether_type == 0x88A8 || ether_type == 0x9100;
}

/// The IP packet in a link-layer frame, with the frame's VLAN and the sender's link-layer address.
struct LinkPayload {
  Bytes ip;
  std::uint32_t vlan = 0;        ///< See Datagram.
  std::uint64_t source_mac = 0;  ///< See Datagram.
};

/// The size of a link-layer header and the offsets of its fields.
struct LinkHeader {
  std::size_t bytes, type_at, mac_at;
};
constexpr LinkHeader kEthernetHeader{14, 12, 6};
constexpr LinkHeader kCookedV1Header{16, 14, 6};
constexpr LinkHeader kCookedV2Header{20, 0, 12};

tl::expected<LinkPayload, FrameReject> after_ether_type(Bytes frame,
                                                        const LinkHeader& header) noexcept {
  if (frame.size() < header.bytes) return Rejected(FrameReject::kShortCapture);
  std::uint16_t type = big_u16(frame, header.type_at);
  LinkPayload payload{.ip = frame.subspan(header.bytes)};
  while (is_vlan_tag(type)) {
    Bytes& rest = payload.ip;
    if (rest.size() < 4) return Rejected(FrameReject::kShortCapture);
    constexpr std::uint32_t kVlanBits = 0xFFF;
    if (const std::uint32_t id = big_u16(rest, 0) & kVlanBits; id != 0) {  // 0: only a priority
      payload.vlan = (payload.vlan & kVlanBits) << 12 | id;
    }
    type = big_u16(rest, 2);
    rest = rest.subspan(4);
  }
  if (type == kEtherTypeIpv6) return Rejected(FrameReject::kIpv6);
  if (type != kEtherTypeIpv4) return Rejected(FrameReject::kNotIpv4);
  payload.source_mac =
      std::uint64_t{big_u16(frame, header.mac_at)} << 32 | big_u32(frame, header.mac_at + 2);
  return payload;
}

/// Skips the address family in front of the IP packet. Links of type NULL hold it in the capturing
/// machine's byte order, links of type LOOP in network byte order.
tl::expected<LinkPayload, FrameReject> after_family(Bytes frame) noexcept {
  if (frame.size() < 4) return Rejected(FrameReject::kShortCapture);
  const std::uint32_t big = big_u32(frame, 0);
  const std::uint32_t family = (big & 0xFFFF) != 0 ? big : big >> 24;
  switch (family) {
    case 2:  // AF_INET everywhere
      return LinkPayload{.ip = frame.subspan(4)};
    case 10:  // AF_INET6 of Linux, NetBSD/OpenBSD, FreeBSD, macOS
    case 24:
    case 28:
    case 30:
      return Rejected(FrameReject::kIpv6);
    default:
      return Rejected(FrameReject::kNotIpv4);
  }
}

tl::expected<LinkPayload, FrameReject> link_payload(int link_type, Bytes frame) noexcept {
  switch (link_type) {
    case kEthernet:
      return after_ether_type(frame, kEthernetHeader);
    case kCookedV1:
      return after_ether_type(frame, kCookedV1Header);
    case kCookedV2:
      return after_ether_type(frame, kCookedV2Header);
    case kNull:
    case kLoop:
      return after_family(frame);
    case kRawLinux:
    case kRawOpenBsd:
    case kRawInFiles:
    case kIpv4:
      return LinkPayload{.ip = frame};
    default:
      return Rejected(FrameReject::kUnsupportedLinkType);
  }
}

/// An IPv4 packet or a part of one.
struct IpPacket {
  IpFragment fragment;  ///< Its payload may be shorter or, with padding, longer than promised.
  std::optional<std::size_t> promised_bytes;  ///< Of the payload, by the header; empty: unknown.
};

tl::expected<IpPacket, FrameReject> ip_packet(int link_type, Bytes captured) noexcept {
  const auto network = link_payload(link_type, captured);
  if (!network) return Rejected(network.error());
  const Bytes ip = network->ip;

  if (ip.empty()) return Rejected(FrameReject::kShortCapture);
  const int version = ip[0] >> 4;
  if (version == 6) return Rejected(FrameReject::kIpv6);
  if (version != 4) return Rejected(FrameReject::kBadIpHeader);
  const std::size_t header_bytes = std::size_t{ip[0] & 0x0FU} * 4;
  if (header_bytes < 20) return Rejected(FrameReject::kBadIpHeader);
  if (ip.size() < header_bytes) return Rejected(FrameReject::kShortCapture);
  const std::size_t total_bytes = big_u16(ip, 2);
  const bool length_known = total_bytes != 0;
  if (length_known && total_bytes < header_bytes) return Rejected(FrameReject::kBadIpHeader);
  if (ip[9] != kProtocolUdp) return Rejected(FrameReject::kNotUdp);
  const std::uint16_t fragment_field = big_u16(ip, 6);
  constexpr std::uint16_t kMoreFragments = 0x2000;
  constexpr std::uint16_t kFragmentOffset = 0x1FFF;
  constexpr std::size_t kOffsetUnit = 8;
  IpPacket found{.fragment = {.source_address = big_u32(ip, 12),
                              .destination_address = big_u32(ip, 16),
                              .vlan = network->vlan,
                              .source_mac = network->source_mac,
                              .id = big_u16(ip, 4),
                              .at = (fragment_field & kFragmentOffset) * kOffsetUnit,
                              .more = (fragment_field & kMoreFragments) != 0,
                              .payload = ip.subspan(header_bytes)},
                 .promised_bytes = std::nullopt};
  if (length_known) found.promised_bytes = total_bytes - header_bytes;
  return found;
}

tl::expected<Datagram, FrameReject> udp_in(const IpFragment& whole,
                                           std::optional<std::size_t> promised_bytes,
                                           std::int64_t stamp_ns) noexcept {
  const Bytes udp = whole.payload;
  if (promised_bytes && *promised_bytes < kUdpHeaderBytes) {
    return Rejected(FrameReject::kTruncatedUdp);
  }
  if (udp.size() < kUdpHeaderBytes) return Rejected(FrameReject::kShortCapture);
  const std::size_t udp_bytes = big_u16(udp, 4);
  if (udp_bytes < kUdpHeaderBytes || (promised_bytes && udp_bytes > *promised_bytes)) {
    return Rejected(FrameReject::kTruncatedUdp);
  }
  if (udp.size() < udp_bytes) return Rejected(FrameReject::kShortCapture);

  return Datagram{.payload = udp.subspan(kUdpHeaderBytes, udp_bytes - kUdpHeaderBytes),
                  .stamp_ns = stamp_ns,
                  .source_address = whole.source_address,
                  .destination_address = whole.destination_address,
                  .source_port = big_u16(udp, 0),
                  .destination_port = big_u16(udp, 2),
                  .vlan = whole.vlan,
                  .source_mac = whole.source_mac};
}

}  // namespace

std::string_view to_string(FrameReject reason) noexcept {
  switch (reason) {
    case FrameReject::kShortCapture:
      return "short_capture";
    case FrameReject::kNotIpv4:
      return "not_ipv4";
    case FrameReject::kIpv6:
      return "ipv6";
    case FrameReject::kBadIpHeader:
      return "bad_ip_header";
    case FrameReject::kNotUdp:
      return "not_udp";
    case FrameReject::kFragment:
      return "fragment";
    case FrameReject::kTruncatedUdp:
      return "truncated_udp";
    case FrameReject::kUnsupportedLinkType:
      return "unsupported_link_type";
    case FrameReject::kCount:
      break;
  }
  return "unknown";
}

std::string_view description_of(FrameReject reason) noexcept {
  switch (reason) {
    case FrameReject::kShortCapture:
      return "were cut by the recording (a snap length; record with tcpdump -s 0)";
    case FrameReject::kNotIpv4:
      return "are of no IP (ARP, LLDP, ...)";
    case FrameReject::kIpv6:
      return "are IPv6, which no sensor read here speaks";
    case FrameReject::kBadIpHeader:
      return "have an impossible IP header";
    case FrameReject::kNotUdp:
      return "are of no UDP (TCP, ICMP, a tunnel, ...)";
    case FrameReject::kFragment:
      return "are IP fragments of datagrams whose other parts are missing";
    case FrameReject::kTruncatedUdp:
      return "hold a UDP length that does not fit";
    case FrameReject::kUnsupportedLinkType:
      return "are of a link layer that is not read";
    case FrameReject::kCount:
      break;
  }
  return "are unknown";
}

bool is_supported_link_type(int link_type) noexcept {
  const auto probe = link_payload(link_type, {});
  return probe || probe.error() != FrameReject::kUnsupportedLinkType;
}

tl::expected<Datagram, FrameReject> parse_udp_frame(int link_type, Bytes captured,
                                                    std::int64_t stamp_ns) noexcept {
  const auto found = ip_packet(link_type, captured);
  if (!found) return Rejected(found.error());
  if (found->fragment.at != 0 || found->fragment.more) return Rejected(FrameReject::kFragment);
  return udp_in(found->fragment, found->promised_bytes, stamp_ns);
}

std::optional<IpFragment> parse_ip_fragment(int link_type, Bytes captured) noexcept {
  const auto found = ip_packet(link_type, captured);
  if (!found || !found->promised_bytes) return std::nullopt;
  if (found->fragment.payload.size() < *found->promised_bytes) return std::nullopt;
  IpFragment fragment = found->fragment;
  fragment.payload = fragment.payload.first(*found->promised_bytes);
  return fragment;
}

tl::expected<Datagram, FrameReject> parse_udp(const IpFragment& whole,
                                              std::int64_t stamp_ns) noexcept {
  return udp_in(whole, whole.payload.size(), stamp_ns);
}

}  // namespace terracut::packet
