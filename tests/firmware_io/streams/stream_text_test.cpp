// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/streams/stream_text.hpp"

#include <gtest/gtest.h>

namespace terracut::streams {
namespace {

TEST(StreamText, OfAVlanIsItsNumberOrThoseOfTwoTags) {
  for (const char* const text : {"0", "10", "4094", "100.10"}) {
    ASSERT_TRUE(parse_vlan(text)) << text;
    EXPECT_EQ(vlan_text(*parse_vlan(text)), text);
  }
  EXPECT_EQ(parse_vlan("100.10"), 100U << 12 | 10U);
  for (const char* const text : {"", "4095", "-1", "10.", ".10", "0.10", "10.0", "1.2.3", "ten"}) {
    EXPECT_FALSE(parse_vlan(text)) << text;
  }
}

TEST(StreamText, OfALinkLayerAddressIsSixBytes) {
  ASSERT_TRUE(parse_mac("60:76:88:10:23:A1"));
  EXPECT_EQ(*parse_mac("60:76:88:10:23:A1"), 0x6076'8810'23A1U);
  EXPECT_EQ(mac_text(0x6076'8810'23A1U), "60:76:88:10:23:a1");
  for (const char* const text : {"", "60:76:88:10:23", "60-76-88-10-23-a1", "60:76:88:10:23:a1:00",
                                 "6:76:88:10:23:a12", "6g:76:88:10:23:a1"}) {
    EXPECT_FALSE(parse_mac(text)) << text;
  }
}

}  // namespace
}  // namespace terracut::streams
