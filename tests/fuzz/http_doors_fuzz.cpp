// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What clients send to the page or to /metrics, in any order and in pieces, while frames come: no
// crash, answers in HTTP, a player that is told nothing out of range; and whoever comes next is
// answered.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "door_clients.hpp"
#include "tests/support/http_client.hpp"
#include "tools/cli/export/metrics_server.hpp"
#include "tools/cli/view/view_sink.hpp"

namespace {

using namespace terracut;
using terracut::fuzz::require;

const std::array<std::string, 12> kPhrases{
    "GET / HTTP/1.1\r\nHost: 127.0.0.1:8480\r\n\r\n",
    "GET /frames HTTP/1.1\r\nHost: localhost\r\n\r\n",
    "GET /figures HTTP/1.1\r\nHost: localhost\r\nOrigin: http://localhost\r\n\r\n",
    "GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n",
    "HEAD /frames HTTP/1.0\r\n\r\n",
    "POST /control HTTP/1.1\r\nHost: localhost\r\nContent-Length: 43\r\n\r\n"
    "{\"playing\": true, \"seek_s\": 2.5, \"rate\": 2}",
    "POST /control HTTP/1.1\r\nHost: localhost\r\nOrigin: http://evil.example\r\n",
    "Content-Length: ",
    "Transfer-Encoding: chunked\r\n\r\n",
    "Host: evil.example\r\n",
    "\r\n\r\n",
    "Sec-Fetch-Site: cross-site\r\n"};

std::string as_chunk(unsigned how, std::string_view payload) {
  const char* const end = (how & 1) != 0 ? "\r\n" : "\r\n0\r\n\r\n";
  char size[16];
  std::snprintf(size, sizeof size, "%zx\r\n", payload.size());
  return std::string(size).append(payload).append(end);
}

class Told : public cli::ViewedCapture {
 public:
  void obey(const cli::PlayerCommand& command) override {
    require(!command.seek_s || (*command.seek_s >= 0 && *command.seek_s <= 1e9), "sought anywhere");
    require(!command.rate || (*command.rate >= 0.05 && *command.rate <= 20), "any rate");
  }
  [[nodiscard]] cli::PlayerState state() const override { return {}; }
};

void knock_at_page(fuzz::Input& input, bool ends_first) {
  Told capture;
  auto page = cli::ViewSink::open("127.0.0.1:0", {.sensor = "a sensor", .rows = 64, .mount = {}},
                                  &capture, fuzz::kUnhurried)
                  .value();
  const auto port = static_cast<std::uint16_t>(std::stoi(page->url().substr(17)));
  publish::LabelledFrame frame;
  fuzz::DoorClients clients(port, kPhrases, as_chunk, [&](unsigned points) {
    ++frame.record.info.number;
    frame.points.resize(points * 1000);
    require(page->put(frame).has_value());
  });
  clients.run(input);
  if (ends_first) page.reset();
  clients.leave();
  if (!page) return;
  fuzz::require_soon(
      [&] {
        const auto answer = test::get(port, "/figures");
        require(answer.status == 200, "who comes next is not answered");
        return nlohmann::json::parse(answer.body).at("browsers").at("looking").get<int>() == 0;
      },
      "a stream did not end with its client");
}

void knock_at_metrics(fuzz::Input& input, bool ends_first) {
  std::optional<cli::HttpServer> server(
      cli::serve_metrics(
          {INADDR_LOOPBACK, 0}, [](status::MonitorSnapshot&) {}, fuzz::kUnhurried)
          .value());
  const std::uint16_t port = server->port();
  fuzz::DoorClients clients(port, kPhrases, as_chunk, [](unsigned) {});
  clients.run(input);
  if (ends_first) server.reset();
  clients.leave();
  if (!server) return;
  require(test::get(port, "/metrics").status == 200, "who comes next is not answered");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  const std::uint32_t kind = input.next(1);
  ((kind & 1) != 0 ? knock_at_metrics : knock_at_page)(input, (kind & 2) != 0);
  return 0;
}
