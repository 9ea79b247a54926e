// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What viewers send to Foxglove's door, handshakes and frames in any order and in pieces, while
// messages come: no crash, a player that is told nothing out of range, and whoever comes next has a
// place and is greeted.
#include <cstddef>
#include <cstdint>

#include "door_clients.hpp"
#include "pipeline/ros_messages/topics.hpp"
#include "tests/support/web_socket_client.hpp"
#include "tools/cli/foxglove/server.hpp"

namespace {

using namespace terracut;
using terracut::fuzz::require;
using test::web_socket_frame;
using test::WebSocketOp;

const std::string kHandshake =
    test::web_socket_handshake("Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n");

const std::array<std::string, 11> kPhrases{
    kHandshake,
    kHandshake.substr(0, kHandshake.size() - 2) + "Origin: https://evil.example\r\n\r\n",
    "GET / HTTP/1.1\r\nSec-WebSocket-Protocol: foxglove.sdk.v1\r\n\r\n",
    web_socket_frame(WebSocketOp::kText,
                     R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":1}]})"),
    web_socket_frame(
        WebSocketOp::kText,
        R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2},{"id":2,"channelId":6}]})"),
    web_socket_frame(WebSocketOp::kText, R"({"op":"unsubscribe","subscriptionIds":[7,1]})"),
    web_socket_frame(WebSocketOp::kBinary,
                     std::string("\3\0\0\0\x80\x3f\1\0\0\0\0\0\0\0\0\2\0\0\0id", 21)),
    web_socket_frame(WebSocketOp::kPing, "ping"),
    web_socket_frame(WebSocketOp::kClose, "\x03\xe8"),
    web_socket_frame(WebSocketOp::kText, R"({"op":"subscribe",)", false),
    web_socket_frame(WebSocketOp::kContinuation, R"("subscriptions":[]})")};

std::string as_frame(unsigned how, std::string_view payload) {
  return web_socket_frame(static_cast<WebSocketOp>(how & 0xF), payload, (how & 0x10) == 0);
}

class Told : public cli::ViewedCapture {
 public:
  void obey(const cli::PlayerCommand& command) override {
    require(!command.seek_s || (*command.seek_s >= 0 && *command.seek_s <= 1e9), "sought anywhere");
    require(command.rate && *command.rate >= 0.05 && *command.rate <= 20, "any rate");
    state_.playing = command.playing.value_or(true);
  }
  [[nodiscard]] cli::PlayerState state() const override { return state_; }

 private:
  cli::PlayerState state_{.duration_s = 9, .begin_ns = 1'700'000'000'000'000'000};
};

/// 101 unless all places are taken.
int handshake(std::uint16_t port) {
  test::HttpClient client(port);
  client.send(kHandshake);
  const std::string head = client.read_until("\r\n\r\n");
  require(head.starts_with("HTTP/1.1 "), "who comes next is not answered");
  return std::stoi(head.substr(9));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  const bool ends_first = (input.next(1) & 2) != 0;
  Told capture;
  cli::HttpBounds bounds = fuzz::kUnhurried;
  bounds.guests = 3;  // fewer than clients
  std::optional<cli::FoxgloveServer> server(
      cli::FoxgloveServer::start({.at = {INADDR_LOOPBACK, 0},
                                  .name = "a sensor",
                                  .topics = std::vector<bool>(ros_messages::kTopics.size(), true),
                                  .capture = &capture,
                                  .bounds = bounds})
          .value());
  server->keep(ros_messages::kTransformsTopic, 1,
               std::make_shared<const std::vector<std::byte>>(100));
  const std::uint16_t port = server->port();
  fuzz::DoorClients clients(port, kPhrases, as_frame, [&](unsigned what) {
    const std::size_t topic = what % ros_messages::kTopics.size();
    if (!server->is_wanted(topic)) return;
    server->publish(topic, what, std::make_shared<const std::vector<std::byte>>(what * 10'000));
  });
  clients.run(input);
  if (ends_first) server.reset();
  clients.leave();
  if (!server) return 0;
  fuzz::require_soon([&] { return handshake(port) == 101; }, "a viewer's place is not free again");
  fuzz::require_soon(
      [&] {
        for (std::size_t topic = 0; topic < ros_messages::kTopics.size(); ++topic) {
          if (server->is_wanted(topic)) return false;
        }
        return true;
      },
      "a viewer has gone, its subscription has not");
  return 0;
}
