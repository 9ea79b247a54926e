// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/udp_frame.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/firmware_io/capture/capture_bytes.hpp"

namespace terracut::packet {
namespace {

using test::Bytes;
using test::ethernet;
using test::IpFrame;
using test::joined;

constexpr int kEthernet = 1;

FrameReject reason(int link_type, const Bytes& frame) {
  const auto result = parse_udp_frame(link_type, frame, 0);
  EXPECT_FALSE(result.has_value());
  return result ? FrameReject::kCount : result.error();
}

struct LinkCase {
  const char* name;
  int link_type;
  Bytes header;
};

class EveryLinkLayer : public testing::TestWithParam<LinkCase> {};

TEST_P(EveryLinkLayer, GivesTheDatagramInside) {
  const IpFrame ip;
  const Bytes frame = joined({GetParam().header, ip.bytes()});
  const auto datagram = parse_udp_frame(GetParam().link_type, frame, 77);
  ASSERT_TRUE(datagram) << to_string(datagram.error());
  EXPECT_THAT(datagram->payload, testing::ElementsAreArray(ip.payload));
  EXPECT_EQ(datagram->stamp_ns, 77);
  EXPECT_EQ(datagram->source_address, 0xC0A8032BU);
  EXPECT_EQ(datagram->destination_address, 0xC0A803FFU);
  EXPECT_EQ(datagram->source_port, 443);
  EXPECT_EQ(datagram->destination_port, 2368);
}

TEST_P(EveryLinkLayer, NamesEveryCutShortFrame) {
  const Bytes frame = joined({GetParam().header, IpFrame{}.bytes()});
  for (std::size_t size = 0; size < frame.size(); ++size) {
    const Bytes cut(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_EQ(reason(GetParam().link_type, cut), FrameReject::kShortCapture) << size << " bytes";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Capture, EveryLinkLayer,
    testing::Values(LinkCase{"Ethernet", 1, ethernet({})},
                    LinkCase{"OneVlan", 1, ethernet({}, 0x0800, {0x8100})},
                    LinkCase{"StackedVlans", 1, ethernet({}, 0x0800, {0x88A8, 0x8100})},
                    LinkCase{"ThreeVlans", 1, ethernet({}, 0x0800, {0x9100, 0x88A8, 0x8100})},
                    LinkCase{"NullLittleEndian", 0, {2, 0, 0, 0}},
                    LinkCase{"NullBigEndian", 0, {0, 0, 0, 2}}, LinkCase{"Loop", 108, {0, 0, 0, 2}},
                    LinkCase{"RawOnLinux", 12, {}}, LinkCase{"RawOnOpenBsd", 14, {}},
                    LinkCase{"RawInFiles", 101, {}}, LinkCase{"Ipv4", 228, {}},
                    LinkCase{
                        "CookedV1", 113, {0, 3, 0, 1, 0, 6, 2, 2, 2, 2, 2, 2, 0, 0, 0x08, 0x00}},
                    LinkCase{"CookedV1Vlan", 113, {0, 3, 0, 1, 0,    6,    2, 2, 2,    2,
                                                   2, 2, 0, 0, 0x81, 0x00, 0, 7, 0x08, 0x00}},
                    LinkCase{"CookedV2", 276, {0x08, 0x00, 0, 0, 0, 0, 0, 2, 0, 1,
                                               3,    6,    2, 2, 2, 2, 2, 2, 0, 0}}),
    [](const auto& link) { return std::string(link.param.name); });

TEST(UdpFrame, TellsItsVlanAndItsLastSender) {
  struct Case {
    Bytes tags;
    std::uint32_t vlan;
  };
  const Bytes priority{0x81, 0, 0xE0, 0}, ten{0x81, 0, 0x20, 10}, hundred{0x88, 0xA8, 0, 100};
  for (const auto& [tags, vlan] :
       {Case{{}, 0}, Case{priority, 0}, Case{ten, 10}, Case{joined({hundred, ten}), 100 << 12 | 10},
        Case{joined({priority, ten}), 10}, Case{joined({ten, hundred, ten}), 100 << 12 | 10}}) {
    const Bytes addresses{2, 2, 2, 2, 2, 2, 0x60, 0x76, 0x88, 0x10, 0x23, 0xA1};
    const Bytes frame = joined({addresses, tags, {0x08, 0x00}, IpFrame{}.bytes()});
    const auto datagram = parse_udp_frame(kEthernet, frame, 0);
    ASSERT_TRUE(datagram);
    EXPECT_EQ(datagram->vlan, vlan);
    EXPECT_EQ(datagram->source_mac, 0x6076'8810'23A1U);
  }
}

TEST(UdpFrame, SaysInWordsWhatEachRejectIs) {
  std::set<std::string_view> words;
  for (std::size_t i = 0; i < kFrameRejects; ++i) {
    words.insert(description_of(static_cast<FrameReject>(i)));
  }
  EXPECT_EQ(words.size(), kFrameRejects);
}

TEST(UdpFrame, StepsOverIpOptionsAndEthernetPadding) {
  IpFrame ip;
  ip.option_bytes = 12;
  const Bytes frame = joined({ethernet(ip.bytes()), Bytes(18, 0xEE)});
  const auto datagram = parse_udp_frame(kEthernet, frame, 0);
  ASSERT_TRUE(datagram);
  EXPECT_THAT(datagram->payload, testing::ElementsAreArray(ip.payload));
}

TEST(UdpFrame, DeliversAnEmptyPayload) {
  IpFrame ip;
  ip.payload.clear();
  const auto datagram = parse_udp_frame(kEthernet, ethernet(ip.bytes()), 0);
  ASSERT_TRUE(datagram);
  EXPECT_TRUE(datagram->payload.empty());
}

TEST(UdpFrame, AcceptsAnUnknownTotalLengthWhenTheUdpLengthFits) {
  IpFrame ip;
  ip.zero_total_length = true;
  EXPECT_TRUE(parse_udp_frame(kEthernet, ethernet(ip.bytes()), 0));
  ip.udp_length_error = 1;
  EXPECT_EQ(reason(kEthernet, ethernet(ip.bytes())), FrameReject::kShortCapture);
}

TEST(UdpFrame, RefusesAFragmentByName) {
  IpFrame first;
  first.fragment_field = 0x2000;  // more fragments follow
  EXPECT_EQ(reason(kEthernet, ethernet(first.bytes())), FrameReject::kFragment);
  IpFrame last;
  last.fragment_field = 0x00B9;
  EXPECT_EQ(reason(kEthernet, ethernet(last.bytes())), FrameReject::kFragment);
  IpFrame whole;
  whole.fragment_field = 0x4000;  // "do not fragment" is no fragment
  EXPECT_TRUE(parse_udp_frame(kEthernet, ethernet(whole.bytes()), 0));
}

TEST(UdpFrame, RefusesOtherProtocolsByName) {
  IpFrame tcp;
  tcp.protocol = 6;
  EXPECT_EQ(reason(kEthernet, ethernet(tcp.bytes())), FrameReject::kNotUdp);
  EXPECT_EQ(reason(kEthernet, ethernet(Bytes(28, 0), 0x0806)), FrameReject::kNotIpv4);  // ARP
  EXPECT_EQ(reason(kEthernet, ethernet(Bytes(40, 0), 0x0026)), FrameReject::kNotIpv4);  // 802.3
  EXPECT_EQ(reason(kEthernet, ethernet(Bytes(40, 0), 0x86DD)), FrameReject::kIpv6);
  EXPECT_EQ(reason(0, {30, 0, 0, 0, 0x60}), FrameReject::kIpv6);
  EXPECT_EQ(reason(0, {9, 0, 0, 0, 0x60}), FrameReject::kNotIpv4);
  EXPECT_EQ(reason(101, Bytes(40, 0x60)), FrameReject::kIpv6);
}

TEST(UdpFrame, RefusesImpossibleIpHeaders) {
  IpFrame version;
  version.version = 5;
  EXPECT_EQ(reason(kEthernet, ethernet(version.bytes())), FrameReject::kBadIpHeader);
  Bytes short_header = IpFrame{}.bytes();
  short_header[0] = 0x44;  // 16 bytes
  EXPECT_EQ(reason(kEthernet, ethernet(short_header)), FrameReject::kBadIpHeader);
  IpFrame total;
  total.total_length_error = -(8 + 10 + 1);
  EXPECT_EQ(reason(kEthernet, ethernet(total.bytes())), FrameReject::kBadIpHeader);
}

TEST(UdpFrame, RefusesUdpLengthsThatDoNotFit) {
  IpFrame too_long;
  too_long.udp_length_error = 1;
  EXPECT_EQ(reason(kEthernet, ethernet(too_long.bytes())), FrameReject::kTruncatedUdp);
  IpFrame too_short;
  too_short.udp_length_error = -11;  // 7: below its own header
  EXPECT_EQ(reason(kEthernet, ethernet(too_short.bytes())), FrameReject::kTruncatedUdp);
  IpFrame ip_too_short;
  ip_too_short.total_length_error = -11;  // 7 bytes left for UDP
  EXPECT_EQ(reason(kEthernet, ethernet(ip_too_short.bytes())), FrameReject::kTruncatedUdp);
}

TEST(UdpFrame, RefusesLinkLayersItDoesNotKnow) {
  for (const int link_type : {-1, 105, 227, 9999}) {
    EXPECT_FALSE(is_supported_link_type(link_type));
    EXPECT_EQ(reason(link_type, ethernet(IpFrame{}.bytes())), FrameReject::kUnsupportedLinkType);
  }
  for (const int link_type : {0, 1, 12, 14, 101, 108, 113, 228, 276}) {
    EXPECT_TRUE(is_supported_link_type(link_type)) << link_type;
  }
}

TEST(UdpFrame, EveryReasonHasItsOwnName) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kFrameRejects; ++i) {
    names.insert(to_string(static_cast<FrameReject>(i)));
  }
  EXPECT_EQ(names.size(), kFrameRejects);
  EXPECT_FALSE(names.contains("unknown"));
  EXPECT_EQ(to_string(FrameReject::kCount), "unknown");
}

}  // namespace
}  // namespace terracut::packet
