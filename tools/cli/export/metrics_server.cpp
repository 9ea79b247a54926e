// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "metrics_server.hpp"

#include <httplib.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "http_host.hpp"
#include "http_port.hpp"
#include "metrics_text.hpp"

namespace terracut::cli {
namespace {

constexpr const char* kMetricsType = "text/plain; version=0.0.4; charset=utf-8";

/// Returns on the thread that accepts, so that there is never more than one connection open.
class OneAtATime final : public httplib::TaskQueue {
  using Taken = decltype(std::declval<httplib::TaskQueue&>().enqueue({}));  // void, later bool

 public:
  Taken enqueue(std::function<void()> request) override {
    request();
    return Taken(true);
  }
  void shutdown() override {}
};

}  // namespace

/// Shared with the server's thread, which may outlive the MetricsServer while a client dawdles.
struct MetricsServer::State {
  httplib::Server server;
  std::uint16_t port = 0;

  std::mutex mutex;
  Source source;  ///< Empty once stopped. Guarded by mutex, as are figures and done.
  status::MonitorSnapshot figures;
  bool done = false;  ///< The thread has left the server.
  std::condition_variable done_changed;

  void answer(httplib::Response& response) {
    const std::lock_guard lock(mutex);
    if (!source) {
      response.status = 503;
      return;
    }
    source(figures);
    response.set_content(metrics_text(figures), kMetricsType);
  }
  void serve() {
    server.listen_after_bind();
    const std::lock_guard lock(mutex);
    done = true;
    done_changed.notify_all();
  }
};

Expected<MetricsServer> MetricsServer::start(const std::string& address, std::uint16_t port,
                                             Source source) {
  auto state = std::make_shared<State>();
  state->source = std::move(source);
  httplib::Server& server = state->server;
  server.new_task_queue = [] { return new OneAtATime; };  // the server deletes it
  server.set_keep_alive_max_count(1);
  server.set_keep_alive_timeout(1);  // also how long a client may take to begin its request
  server.set_read_timeout(1);
  server.set_write_timeout(1);
  server.set_payload_max_length(4096);
  server.set_pre_routing_handler(
      [name = own_host_name()](const httplib::Request& request, httplib::Response& response) {
        using Handling = httplib::Server::HandlerResponse;
        if (names_this_machine(request.get_header_value("Host"), name)) return Handling::Unhandled;
        response.status = 403;
        response.set_content("ask by this machine's address, as localhost or as '" + name + "'\n",
                             "text/plain");
        return Handling::Handled;
      });
  server.Get("/metrics", [raw = state.get()](const httplib::Request&, httplib::Response& response) {
    raw->answer(response);
  });
  server.Get("/", [](const httplib::Request&, httplib::Response& response) {
    response.set_content("terracut's figures for Prometheus are at /metrics\n", "text/plain");
  });

  const auto bound = bind_http(server, address, port, "/metrics");
  if (!bound) return tl::unexpected(bound.error());
  state->port = *bound;
  std::thread([state] { state->serve(); }).detach();
  // Stopping a server that is not yet running would have no effect.
  while (!server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return MetricsServer(std::move(state));
}

MetricsServer::MetricsServer(std::shared_ptr<State> state) : state_(std::move(state)) {}
MetricsServer::MetricsServer(MetricsServer&&) noexcept = default;

std::uint16_t MetricsServer::port() const noexcept {
  return state_->port;
}

MetricsServer::~MetricsServer() {
  if (!state_) return;
  std::unique_lock lock(state_->mutex);
  state_->source = nullptr;
  lock.unlock();
  state_->server.stop();
  lock.lock();
  state_->done_changed.wait_for(lock, std::chrono::seconds(2), [this] { return state_->done; });
}

}  // namespace terracut::cli
