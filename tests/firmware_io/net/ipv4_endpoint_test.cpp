// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/ipv4_endpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace terracut::test {
namespace {

using net::Ipv4Endpoint;
using net::parse_ipv4_endpoint;

TEST(Ipv4Endpoint, IsReadAsPeopleWriteIt) {
  EXPECT_EQ(*parse_ipv4_endpoint("192.168.3.43:2368"), (Ipv4Endpoint{0xC0A8032B, 2368}));
  EXPECT_EQ(*parse_ipv4_endpoint(":6699"), (Ipv4Endpoint{0, 6699}));
  EXPECT_EQ(*parse_ipv4_endpoint("6699"), (Ipv4Endpoint{0, 6699}));
  EXPECT_EQ(*parse_ipv4_endpoint("0.0.0.0:0"), (Ipv4Endpoint{}));
  EXPECT_EQ(*parse_ipv4_endpoint("255.255.255.255:65535"), (Ipv4Endpoint{0xFFFFFFFF, 65535}));
}

TEST(Ipv4Endpoint, IsWrittenAsItIsRead) {
  for (const char* text : {"192.168.3.43:2368", "0.0.0.0:1", "239.1.2.3:65535"}) {
    EXPECT_EQ(to_string(*parse_ipv4_endpoint(text)), text);
  }
}

TEST(Ipv4Endpoint, ThatIsNoneSaysWhatIsExpected) {
  for (const char* text : {"", ":", "here:2368", "1.2.3:5", "1.2.3.4:", "1.2.3.4:65536",
                           "1.2.3.4:-1", "1.2.3.4:23 ", "1.2.3.4", "::1:2368", "256.1.1.1:1"}) {
    const auto endpoint = parse_ipv4_endpoint(text);
    ASSERT_FALSE(endpoint) << text;
    EXPECT_EQ(endpoint.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(endpoint.error().message, testing::HasSubstr("192.168.3.43")) << text;
  }
}

TEST(Ipv4Endpoint, KnowsMulticastGroups) {
  EXPECT_TRUE(net::is_multicast(0xE0000000));
  EXPECT_TRUE(net::is_multicast(0xEFFFFFFF));
  EXPECT_FALSE(net::is_multicast(0xDFFFFFFF));
  EXPECT_FALSE(net::is_multicast(0xF0000000));
}

TEST(Ipv4Sender, IsAnAddressOrOneWithAPort) {
  EXPECT_EQ(*net::parse_ipv4_sender("10.0.0.7"), net::Sender{0x0A000007});
  EXPECT_EQ(*net::parse_ipv4_sender("10.0.0.7:2368"), (net::Sender{0x0A000007, 2368}));
  for (const char* const text : {"10.0.0.7", "10.0.0.7:2368"}) {
    EXPECT_EQ(to_string(*net::parse_ipv4_sender(text)), text);
  }
  for (const char* const text : {"", "2368", ":2368", "10.0.0.7:", "10.0.0.7:0", "10.0.0:1"}) {
    EXPECT_FALSE(net::parse_ipv4_sender(text)) << text;
  }
}

}  // namespace
}  // namespace terracut::test
