// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <tl/expected.hpp>

#include "firmware_io/packet/datagram.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::packet {

/// Why a captured frame holds no usable datagram.
enum class FrameReject : std::uint8_t {
  kShortCapture,         ///< Fewer bytes were captured than the frame's headers promise.
  kNotIpv4,              ///< The frame holds ARP, LLDP, 802.3 or another protocol.
  kIpv6,                 ///< The frame holds IPv6, which no supported sensor sends.
  kBadIpHeader,          ///< Version, header length or total length are impossible.
  kNotUdp,               ///< The packet holds TCP, ICMP, IGMP or the like.
  kFragment,             ///< Part of a fragmented datagram (IpFragment).
  kTruncatedUdp,         ///< The UDP length is below 8 or beyond the IP packet.
  kUnsupportedLinkType,  ///< See is_supported_link_type().
  kCount,
};
inline constexpr std::size_t kFrameRejects = static_cast<std::size_t>(FrameReject::kCount);

/// Returns a stable lower_snake_case name, as in the JSON report.
[[nodiscard]] std::string_view to_string(FrameReject reason) noexcept;
/// Describes several frames with this reason as the end of a sentence for people: "are IPv6, ...",
/// with advice if there is any.
[[nodiscard]] std::string_view description_of(FrameReject reason) noexcept;

/// True for libpcap's DLT_ numbers of the link layers understood: NULL (0), Ethernet (1), RAW (12,
/// 14, 101), LOOP (108), Linux cooked v1 (113) and v2 (276), IPv4 (228).
[[nodiscard]] bool is_supported_link_type(int link_type) noexcept;

/// Finds the UDP payload of one captured link-layer frame. Skips VLAN tags (0x8100, 0x88A8, 0x9100;
/// stacked), IP options and Ethernet padding. Reads no byte outside `captured`. Checksums are not
/// verified, because captures made on the sending machine often hold unfinished ones. An IP total
/// length of 0 (segmentation offload) is accepted if the UDP length fits. The payload points into
/// `captured`. Allocates nothing; may be called on the packet path.
[[nodiscard]] tl::expected<Datagram, FrameReject> parse_udp_frame(
    int link_type, std::span<const std::uint8_t> captured,
    std::int64_t stamp_ns) noexcept TERRACUT_NONBLOCKING;

/// A fragment of an IPv4 packet that carries UDP, or a whole one.
struct IpFragment {
  std::uint32_t source_address = 0, destination_address = 0, vlan = 0;  ///< See Datagram.
  std::uint64_t source_mac = 0;
  std::uint16_t id = 0;                     ///< The packet's number, the same in all its fragments.
  std::size_t at = 0;                       ///< Where its payload begins in the packet's.
  bool more = false;                        ///< True unless it is the packet's last part.
  std::span<const std::uint8_t> payload{};  ///< Without the IP header; points into the frame.
};

/// Finds the fragment in a frame for which parse_udp_frame() says kFragment; nothing if the frame
/// holds fewer bytes than it promises. Allocates nothing.
[[nodiscard]] std::optional<IpFragment> parse_ip_fragment(
    int link_type, std::span<const std::uint8_t> captured) noexcept TERRACUT_NONBLOCKING;

/// Finds the UDP payload of a whole packet, as parse_udp_frame() does.
[[nodiscard]] tl::expected<Datagram, FrameReject> parse_udp(
    const IpFragment& whole, std::int64_t stamp_ns) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::packet
