// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/stream_address.hpp"

#include <gmock/gmock.h>

namespace terracut::stream {
namespace {

std::string understood(std::string_view text) {
  const auto address = parse_stream_address(text);
  return address ? to_string(*address) : "refused: " + address.error().message;
}

TEST(StreamAddress, APortAloneIsOnTheLoopbackAddress) {
  EXPECT_EQ(understood("7447"), "127.0.0.1:7447");
  EXPECT_EQ(understood(":7447"), "127.0.0.1:7447");
  EXPECT_EQ(to_string(StreamAddress{}), "127.0.0.1:0");
}

TEST(StreamAddress, OthersAreServedOnTheLoopbackAddressUnlessAnotherIsGiven) {
  EXPECT_EQ(to_string(parse_serving_endpoint("9464").value()), "127.0.0.1:9464");
  EXPECT_EQ(to_string(parse_serving_endpoint(":9464").value()), "127.0.0.1:9464");
  EXPECT_EQ(to_string(parse_serving_endpoint("0.0.0.0:9464").value()), "0.0.0.0:9464");
  EXPECT_EQ(to_string(parse_serving_endpoint("10.0.0.1:9464").value()), "10.0.0.1:9464");
  EXPECT_FALSE(parse_serving_endpoint("off"));
}

TEST(StreamAddress, AnAddressIsTakenAsItIs) {
  EXPECT_EQ(understood("192.168.3.10:7447"), "192.168.3.10:7447");
  EXPECT_EQ(understood("0.0.0.0:7447"), "0.0.0.0:7447");
}

TEST(StreamAddress, ATextWithASlashIsAUnixSocket) {
  EXPECT_EQ(understood("/run/terracut/frames"), "/run/terracut/frames");
  EXPECT_EQ(understood("./frames"), "./frames");
  EXPECT_TRUE(parse_stream_address("./frames")->is_unix());
}

TEST(StreamAddress, AnythingElseIsRefusedWithWhatWasExpected) {
  for (const char* text : {"", "localhost:7447", "127.0.0.1:70000", "127.0.0.1", "frames"}) {
    SCOPED_TRACE(text);
    const auto address = parse_stream_address(text);
    ASSERT_FALSE(address.has_value());
    EXPECT_EQ(address.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(address.error().message, testing::HasSubstr("127.0.0.1:7447"));
  }
}

TEST(StreamAddress, APathTooLongForASocketIsRefused) {
  EXPECT_TRUE(parse_stream_address("/" + std::string(106, 'x')).has_value());
  EXPECT_THAT(understood("/" + std::string(107, 'x')), testing::HasSubstr("at most 107"));
}

}  // namespace
}  // namespace terracut::stream
