// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "view_server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <chrono>
#include <thread>
#include <utility>

#include "tools/cli/export/http_port.hpp"

namespace terracut::cli {
namespace {

/// Every browser's stream holds a thread; as many answer the short requests.
constexpr std::size_t kThreads = 2 * kMostViewers;
/// A browser that takes nothing for so long has stopped: it may come again.
constexpr std::time_t kStall_s = 5;

}  // namespace

struct ViewServer::State {
  explicit State(ViewSource& of) : source(of) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    source.is_over = true;
    if (!listening.joinable()) return;
    server.stop();
    listening.join();
  }

  ViewSource& source;
  httplib::Server server;
  std::string url;
  std::thread listening;
};

Expected<ViewServer> ViewServer::start(const std::string& address, std::uint16_t port,
                                       ViewSource& source) {
  auto state = std::make_unique<State>(source);
  httplib::Server& server = state->server;
  server.new_task_queue = [] {
    return new httplib::ThreadPool(kThreads);
  };  // the server deletes it
  server.set_keep_alive_max_count(1);
  server.set_read_timeout(1);
  server.set_write_timeout(kStall_s);
  server.set_payload_max_length(4096);
  route_view(server, source);
  const auto bound = bind_http(server, address, port, "the page");
  if (!bound) return tl::unexpected(bound.error());
  const bool is_anywhere = address == "0.0.0.0";
  state->url = fmt::format("http://{}:{}/", is_anywhere ? "127.0.0.1" : address, *bound);
  state->listening = std::thread([raw = state.get()] { raw->server.listen_after_bind(); });
  // Stopping a server that is not yet running would have no effect.
  while (!server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return ViewServer(std::move(state));
}

ViewServer::ViewServer(std::unique_ptr<State> state) : state_(std::move(state)) {}
ViewServer::ViewServer(ViewServer&&) noexcept = default;
ViewServer::~ViewServer() = default;

const std::string& ViewServer::url() const noexcept {
  return state_->url;
}

}  // namespace terracut::cli
