// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Any bytes as what a browser sends to the page's server: no crash, an answer to each or none, and
// a player is told nothing that is out of range, nor anything by another origin or for another
// host.
#include <httplib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "input.hpp"
#include "tools/cli/export/http_host.hpp"
#include "tools/cli/view/view_routes.hpp"

namespace {

using namespace terracut;
using terracut::fuzz::require;

class Bytes : public httplib::Stream {
 public:
  explicit Bytes(std::string request) : request_(std::move(request)) {}
  [[nodiscard]] bool is_readable() const override { return true; }
  [[nodiscard]] bool is_writable() const override { return true; }
  ssize_t read(char* into, std::size_t size) override {
    const std::size_t count = std::min(size, request_.size() - read_);
    std::memcpy(into, request_.data() + read_, count);
    read_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* from, std::size_t size) override {
    answer.append(from, size);
    return static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override {
    ip = "127.0.0.1", port = 1;
  }
  void get_local_ip_and_port(std::string& ip, int& port) const override {
    ip = "127.0.0.1", port = 2;
  }
  [[nodiscard]] socket_t socket() const override { return 0; }

  std::string answer;

 private:
  std::string request_;
  std::size_t read_ = 0;
};

class Server : public httplib::Server {
 public:
  void answer(Bytes& bytes) {
    bool is_closed = false;
    (void)process_request(bytes, true, is_closed, [this](httplib::Request& request) {
      host = request.get_header_value("Host");
      origin = request.get_header_value("Origin");
    });
  }
  std::string host, origin;
};

class Told : public cli::ViewedCapture {
 public:
  void obey(const cli::PlayerCommand& command) override {
    require(!command.seek_s || (*command.seek_s >= 0 && *command.seek_s <= 1e9), "sought anywhere");
    require(!command.rate || (*command.rate >= 0.05 && *command.rate <= 20), "any rate");
    ++commands;
  }
  [[nodiscard]] cli::PlayerState state() const override { return {}; }
  int commands = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cli::ViewFrames frames({.sensor = "a sensor", .rows = 64, .mount = {}});
  Told capture;
  cli::ViewSource source{frames, &capture};
  source.is_over = true;  // streams end at once
  Server server;
  server.set_payload_max_length(4096);
  cli::route_view(server, source);
  Bytes bytes(std::string(data, data + size));
  server.answer(bytes);
  require(bytes.answer.empty() || bytes.answer.starts_with("HTTP/1.1 "), "no answer in HTTP");
  require(source.streams == 0, "a stream was not ended");
  if (capture.commands == 0) return 0;
  require(capture.commands == 1, "one request told a player twice");
  require(cli::names_this_machine(server.host, cli::own_host_name()), "told for another host");
  require(cli::is_own_origin(server.origin, server.host), "told by another origin");
  return 0;
}
