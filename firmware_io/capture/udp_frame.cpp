// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/udp_frame.hpp"

namespace terracut::capture {
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

tl::expected<Bytes, FrameReject> after_ether_type(Bytes frame, std::size_t type_at,
                                                  std::size_t header_bytes) noexcept {
  if (frame.size() < header_bytes) return Rejected(FrameReject::kShortCapture);
  std::uint16_t type = big_u16(frame, type_at);
  Bytes rest = frame.subspan(header_bytes);
  while (is_vlan_tag(type)) {
    if (rest.size() < 4) return Rejected(FrameReject::kShortCapture);
    type = big_u16(rest, 2);
    rest = rest.subspan(4);
  }
  if (type == kEtherTypeIpv6) return Rejected(FrameReject::kIpv6);
  if (type != kEtherTypeIpv4) return Rejected(FrameReject::kNotIpv4);
  return rest;
}

/// NULL writes the address family in the capturing machine's byte order, LOOP in the network's.
tl::expected<Bytes, FrameReject> after_family(Bytes frame) noexcept {
  if (frame.size() < 4) return Rejected(FrameReject::kShortCapture);
  const std::uint32_t big = big_u32(frame, 0);
  const std::uint32_t family = (big & 0xFFFF) != 0 ? big : big >> 24;
  switch (family) {
    case 2:  // AF_INET everywhere
      return frame.subspan(4);
    case 10:  // AF_INET6 of Linux, NetBSD/OpenBSD, FreeBSD, macOS
    case 24:
    case 28:
    case 30:
      return Rejected(FrameReject::kIpv6);
    default:
      return Rejected(FrameReject::kNotIpv4);
  }
}

tl::expected<Bytes, FrameReject> ip_packet(int link_type, Bytes frame) noexcept {
  switch (link_type) {
    case kEthernet:
      return after_ether_type(frame, 12, 14);
    case kCookedV1:
      return after_ether_type(frame, 14, 16);
    case kCookedV2:
      return after_ether_type(frame, 0, 20);
    case kNull:
    case kLoop:
      return after_family(frame);
    case kRawLinux:
    case kRawOpenBsd:
    case kRawInFiles:
    case kIpv4:
      return frame;
    default:
      return Rejected(FrameReject::kUnsupportedLinkType);
  }
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

bool is_supported_link_type(int link_type) noexcept {
  const auto probe = ip_packet(link_type, {});
  return probe || probe.error() != FrameReject::kUnsupportedLinkType;
}

tl::expected<decode::Datagram, FrameReject> parse_udp_frame(int link_type, Bytes captured,
                                                            std::int64_t stamp_ns) noexcept {
  const auto network = ip_packet(link_type, captured);
  if (!network) return Rejected(network.error());
  const Bytes ip = *network;

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
  if ((fragment_field & (kMoreFragments | kFragmentOffset)) != 0) {
    return Rejected(FrameReject::kFragment);
  }

  const Bytes udp = ip.subspan(header_bytes);
  if (length_known && total_bytes - header_bytes < kUdpHeaderBytes) {
    return Rejected(FrameReject::kTruncatedUdp);
  }
  if (udp.size() < kUdpHeaderBytes) return Rejected(FrameReject::kShortCapture);
  const std::size_t udp_bytes = big_u16(udp, 4);
  if (udp_bytes < kUdpHeaderBytes || (length_known && udp_bytes > total_bytes - header_bytes)) {
    return Rejected(FrameReject::kTruncatedUdp);
  }
  if (udp.size() < udp_bytes) return Rejected(FrameReject::kShortCapture);

  return decode::Datagram{.payload = udp.subspan(kUdpHeaderBytes, udp_bytes - kUdpHeaderBytes),
                          .stamp_ns = stamp_ns,
                          .source_address = big_u32(ip, 12),
                          .destination_address = big_u32(ip, 16),
                          .source_port = big_u16(udp, 0),
                          .destination_port = big_u16(udp, 2)};
}

}  // namespace terracut::capture
