// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/foxglove/protocol.hpp"

#include <gtest/gtest.h>

namespace terracut::cli {
namespace {

TEST(FoxgloveProtocol, EitherNameIsAnsweredAndNoOther) {
  EXPECT_EQ(foxglove_sub_protocol("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(foxglove_sub_protocol("other, foxglove.websocket.v1 , foxglove.sdk.v1"),
            "foxglove.sdk.v1");
  EXPECT_EQ(foxglove_sub_protocol("foxglove.websocket.v2"), "");
  EXPECT_EQ(foxglove_sub_protocol(""), "");
}

TEST(FoxgloveProtocol, SubscriptionsAreUnderstood) {
  const auto request = parse_foxglove_request(
      R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":1},{"id":8,"channelId":2}]})");
  ASSERT_TRUE(request);
  ASSERT_EQ(request->subscribe.size(), 2U);
  EXPECT_EQ(request->subscribe[1].id, 8U);
  EXPECT_EQ(request->subscribe[1].channel_id, 2U);
  const auto end = parse_foxglove_request(R"({"op":"unsubscribe","subscriptionIds":[7,8]})");
  ASSERT_TRUE(end);
  EXPECT_EQ(end->unsubscribe, (std::vector<std::uint32_t>{7, 8}));
}

TEST(FoxgloveProtocol, WhatIsNoRequestIsRefused) {
  for (const std::string_view text :
       {"", "{", "[]", "7", "null", R"({"op":7})", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":{}})", R"({"op":"subscribe","subscriptions":[7]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4294967296}]})",
        R"({"op":"unsubscribe","subscriptionIds":[1.5]})", R"({"op":"publish"})"}) {
    EXPECT_FALSE(parse_foxglove_request(text)) << text;
  }
}

TEST(FoxgloveProtocol, PagesOfThisMachineMayConnectAndOthersThatAreNamed) {
  const std::vector<std::string> allowed{"https://app.foxglove.dev"};
  for (const std::string_view origin : {"", "http://localhost:8080", "http://127.0.0.1:9000",
                                        "https://vehicle", "https://app.foxglove.dev"}) {
    EXPECT_TRUE(is_allowed_origin(origin, "", "vehicle", allowed)) << origin;
  }
  for (const std::string_view origin :
       {"null", "file://", "https://elsewhere.example", "http://192.168.1.7", "http://",
        "localhost", "https://app.foxglove.dev.example", "http://127.0.0.1.example"}) {
    EXPECT_FALSE(is_allowed_origin(origin, "", "vehicle", allowed)) << origin;
  }
}

TEST(FoxgloveProtocol, FilesAreOfADesktopProgramOrOfWhateverABrowserHasDownloaded) {
  EXPECT_TRUE(is_allowed_origin("file://",
                                "Mozilla/5.0 (X11; Linux x86_64) AppleWebKit/537.36 (KHTML, like "
                                "Gecko) Lichtblick/1.10.0 Chrome/126.0.6478.234 Electron/31.7.7 "
                                "Safari/537.36",
                                "vehicle", {}));
  const std::string_view browser =
      "Mozilla/5.0 (X11; Linux x86_64) AppleWebKit/537.36 (KHTML, like Gecko) Chrome/140.0.0.0 "
      "Safari/537.36";
  EXPECT_FALSE(is_allowed_origin("file://", browser, "vehicle", {}));
  EXPECT_TRUE(is_allowed_origin("file://", browser, "vehicle", {"file://"})) << "it was asked for";
}

TEST(FoxgloveProtocol, DataHasTheDocumentedHeader) {
  const auto header = message_data_header(0x01020304, 0x1112131415161718);
  EXPECT_EQ(header[0], std::byte{1});
  EXPECT_EQ(header[1], std::byte{4});
  EXPECT_EQ(header[4], std::byte{1});
  EXPECT_EQ(header[5], std::byte{0x18});
  EXPECT_EQ(header[12], std::byte{0x11});
}

}  // namespace
}  // namespace terracut::cli
