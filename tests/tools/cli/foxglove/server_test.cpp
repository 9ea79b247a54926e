// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/foxglove/server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "pipeline/ros_messages/topics.hpp"
#include "tests/support/web_socket_client.hpp"

namespace terracut::cli {
namespace {

using test::HttpClient;
using test::next_message;
using test::web_socket_frame;
using test::WebSocketOp;
using testing::HasSubstr;

constexpr const char* kProtocol = "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n";

FoxgloveServer start(const HttpBounds& bounds = {}) {
  auto server =
      FoxgloveServer::start({.at = {INADDR_LOOPBACK, 0},
                             .name = "a made sensor",
                             .topics = std::vector<bool>(ros_messages::kTopics.size(), true),
                             .bounds = bounds});
  if (!server) throw std::runtime_error(server.error().message);
  return *std::move(server);
}

/// One that was greeted.
std::unique_ptr<HttpClient> viewer(const FoxgloveServer& server, int receive_buffer_bytes = 0) {
  auto client = std::make_unique<HttpClient>(server.port(), receive_buffer_bytes);
  client->send(test::web_socket_handshake(kProtocol));
  EXPECT_THAT(client->read_until("\r\n\r\n"), HasSubstr("HTTP/1.1 101"));
  EXPECT_THAT(next_message(*client).payload, HasSubstr("serverInfo"));
  EXPECT_THAT(next_message(*client).payload, HasSubstr("advertise"));
  return client;
}

void say(HttpClient& client, std::string_view text) {
  EXPECT_TRUE(client.send(web_socket_frame(WebSocketOp::kText, text)));
}

FoxgloveServer::Message message_of(std::size_t bytes) {
  return std::make_shared<const std::vector<std::byte>>(bytes);
}

TEST(FoxgloveServer, GivesAViewerWhatItSubscribedTo) {
  FoxgloveServer server = start();
  const auto client = viewer(server);
  EXPECT_FALSE(server.is_wanted(0));
  say(*client, R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":1}]})");
  while (!server.is_wanted(0)) std::this_thread::yield();
  server.publish(1, 5, message_of(3));
  server.publish(0, 6, message_of(100));
  const auto message = next_message(*client);
  EXPECT_EQ(message.op, WebSocketOp::kBinary);
  EXPECT_EQ(message.payload.size(), 113U);
  EXPECT_EQ(message.payload[1], 7);
}

TEST(FoxgloveServer, HoldsOneMessageAChannelForAViewerThatStops) {
  FoxgloveServer server = start();
  const auto client = viewer(server);
  std::string many = R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":1})";
  for (int id = 1; id < 60; ++id) many += ",{\"id\":" + std::to_string(id) + ",\"channelId\":1}";
  say(*client, many + "]}");
  EXPECT_THAT(next_message(*client).payload, HasSubstr("to this channel"));
  while (server.figures().bad_requests < 59) std::this_thread::yield();
  EXPECT_TRUE(server.is_wanted(0));
}

TEST(FoxgloveServer, DisconnectsAViewerThatTakesNothingWhileOthersAreServed) {
  FoxgloveServer server = start({.stall_time = std::chrono::milliseconds(300)});
  const std::string subscribe = R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":1}]})";
  const auto stopped = viewer(server, 4096), other = viewer(server);
  say(*stopped, subscribe);
  while (!server.is_wanted(0)) std::this_thread::yield();
  const auto cloud = message_of(64'000'000);  // more than any socket keeps
  server.publish(0, 6, cloud);

  say(*other, subscribe);
  say(*other, subscribe);
  EXPECT_THAT(next_message(*other).payload, HasSubstr("to this channel")) << "the first was heard";
  server.publish(0, 7, message_of(10));
  EXPECT_EQ(next_message(*other).payload.size(), 23U);
  while (server.connections().stalled == 0) std::this_thread::yield();
  EXPECT_LT(stopped->rest().size(), cloud->size());
}

TEST(FoxgloveServer, TurnsAwayMoreViewersThanItServesAndTellsWhy) {
  FoxgloveServer server = start({.guests = 1});
  auto first = viewer(server);
  HttpClient second(server.port());
  second.send(test::web_socket_handshake(kProtocol));
  EXPECT_EQ(second.response().status, 503);
  EXPECT_EQ(server.connections().refused, 1U);
  first.reset();
  for (int status = 503; status != 101;) {
    HttpClient next(server.port());
    next.send(test::web_socket_handshake(kProtocol));
    status = std::stoi(next.read_until("\r\n\r\n").substr(9));
  }
}

TEST(FoxgloveServer, RefusesOtherOriginsProtocolsAndWhatIsNoWebSocket) {
  FoxgloveServer server = start();
  const auto status_of = [&](const std::string& request) {
    HttpClient client(server.port());
    client.send(request);
    return client.response().status;
  };
  const std::string protocol = kProtocol;
  EXPECT_EQ(status_of(test::web_socket_handshake(protocol + "Origin: https://evil.example\r\n")),
            403);
  EXPECT_EQ(status_of(test::web_socket_handshake(protocol + "Origin: file://\r\n")), 403);
  EXPECT_EQ(status_of(test::web_socket_handshake(
                protocol + "Origin: http://localhost\r\nOrigin: https://evil.example\r\n")),
            400);
  EXPECT_EQ(status_of(test::web_socket_handshake("Sec-WebSocket-Protocol: other\r\n")), 400);
  EXPECT_EQ(status_of("GET / HTTP/1.1\r\nHost: localhost\r\n" + protocol + "\r\n"), 400);
  EXPECT_EQ(status_of("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"), 400);
}

TEST(FoxgloveServer, EndsAConnectionWhoseFramesAreNoneOrTooLong) {
  FoxgloveServer server = start();
  for (const std::string& frame :
       {std::string("\x81\x02{}"), web_socket_frame(WebSocketOp{3}, "x"),
        web_socket_frame(WebSocketOp::kText, std::string(20'000, 'x'))}) {
    const auto client = viewer(server);
    client->send(frame);
    EXPECT_EQ(next_message(*client).op, WebSocketOp::kClose);
  }
  const auto client = viewer(server);
  say(*client, "{");
  EXPECT_THAT(next_message(*client).payload, HasSubstr("not understood"));
}

}  // namespace
}  // namespace terracut::cli
