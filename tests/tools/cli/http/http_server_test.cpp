// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/http/http_server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <boost/asio/write.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/http_client.hpp"
#include "tests/support/no_threads.hpp"
#include "tools/cli/http/http_connection.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using test::ask;
using test::get;
using test::HttpClient;

std::size_t open_descriptors() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& each : std::filesystem::directory_iterator("/proc/self/fd")) {
    ++count;
  }
  return count;
}

[[maybe_unused]] std::size_t resident_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) return std::stoul(line.substr(6));
  }
  return 0;
}

/// Writes 64 MB to its client, which is more than any socket keeps.
class Flood final : public HttpGuest, public std::enable_shared_from_this<Flood> {
 public:
  explicit Flood(HttpStream stream) : stream_(std::move(stream)) {}
  void begin() {
    boost::asio::async_write(stream_, boost::asio::buffer(bytes_),
                             [self = shared_from_this()](auto, std::size_t) {});
  }
  HttpStream& stream() noexcept override { return stream_; }

 private:
  HttpStream stream_;
  std::string bytes_ = std::string(64'000'000, 'x');
};

/// "/": a word; "/echo": the body; "/fail": throws; "/flood": a guest.
HttpReply answer(const HttpRequest& asked) {
  if (asked.path == "/echo") return HttpAnswer{.body = std::string(asked.body)};
  if (asked.path == "/fail") throw std::bad_alloc();
  if (asked.path != "/flood") return HttpAnswer{.body = "a word\n"};
  return HttpTakeover([](HttpConnection&& connection) {
    auto flood = std::make_shared<Flood>(std::move(connection.stream));
    flood->begin();
    return flood;
  });
}

HttpServer start(const HttpBounds& bounds = {}) {
  auto server =
      HttpServer::start({.at = {INADDR_LOOPBACK, 0}, .what = "words", .bounds = bounds}, answer);
  if (!server) throw std::runtime_error(server.error().message);
  return *std::move(server);
}

void ask_for_flood(HttpClient& client) {
  client.send("GET /flood HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(client.read(1), "x");
}

TEST(HttpServer, AnswersOneRequestAConnection) {
  const HttpServer server = start();
  const auto got = get(server.port(), "/");
  EXPECT_EQ(got.status, 200);
  EXPECT_EQ(got.body, "a word\n");
  EXPECT_THAT(got.head, HasSubstr("Connection: close"));
  EXPECT_EQ(ask(server.port(), "POST", "/echo", {}, "some bytes").body, "some bytes");
  const auto head = ask(server.port(), "HEAD", "/");
  EXPECT_THAT(head.head, HasSubstr("Content-Length: 7"));
  EXPECT_EQ(head.body, "");
  EXPECT_EQ(server.figures().refused, 0U);
}

TEST(HttpServer, TakesNoMemoryForWhatIsSentWithoutEnd) {
  const HttpServer server = start({.visit_time = milliseconds(300)});
  [[maybe_unused]] const auto resident_before_kib = resident_kib();
  const std::string megabyte(1 << 20, 'x');
  std::string headers;
  for (int i = 0; i < 20'000; ++i) headers += "X-" + std::to_string(i) + ": " + "y\r\n";
  std::string chunks;
  for (int i = 0; i < 200; ++i) chunks += "1000\r\n" + std::string(0x1000, 'z') + "\r\n";
  struct Attack {
    std::string begin, more;
    int status;
  };
  for (const Attack& attack :
       {Attack{"GET / HTTP/1.1\r\n", headers, 431},
        {"GET /", megabyte, 431},
        {"GET / HTTP/1.1\r\nX: ", megabyte, 431},
        {"POST /echo HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n", chunks,
         411},
        {"POST /echo HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100000000\r\n\r\n", megabyte,
         413},
        {"POST /echo HTTP/1.1\r\nHost: localhost\r\nContent-Length: 18446744073709551616\r\n\r\n",
         megabyte, 400}}) {
    HttpClient client(server.port());
    client.send(attack.begin);
    std::thread sender([&] {
      for (int i = 0; i < 100 && client.send(attack.more); ++i) {
      }
    });
    EXPECT_EQ(client.response().status, attack.status) << attack.begin;
    sender.join();
  }
#ifndef TERRACUT_SANITIZED_BUILD  // which keep what was freed
  // What the test itself keeps lies in there as well.
  EXPECT_LT(resident_kib(), resident_before_kib + 16'000);
#endif
  EXPECT_EQ(server.figures().refused, 6U);
}

TEST(HttpServer, AnswersWhoAsksWhileOthersComeAndSayNothing) {
  const HttpServer server = start();
  const std::size_t descriptors_before = open_descriptors();
  std::vector<std::unique_ptr<HttpClient>> silent;
  for (int i = 0; i < 300; ++i) {
    silent.push_back(std::make_unique<HttpClient>(server.port()));
    if (i % 2 == 0) silent.back()->send("GET / HTTP/1.1\r\nX-");
  }
  EXPECT_EQ(get(server.port(), "/").status, 200);
  EXPECT_LE(open_descriptors(), descriptors_before + silent.size() + HttpBounds{}.visits + 1);
  EXPECT_TRUE(silent.front()->is_hung_up_on()) << "the oldest makes room";
}

TEST(HttpServer, WaitsForARequestForALimitedTime) {
  const HttpServer server = start({.visit_time = milliseconds(200)});
  HttpClient silent(server.port()), slow(server.port());
  slow.send("GET / HTTP/1.1\r\nHost: ");
  EXPECT_TRUE(silent.is_hung_up_on());
  EXPECT_TRUE(slow.is_hung_up_on());
  EXPECT_EQ(get(server.port(), "/").status, 200);
}

TEST(HttpServer, RestsWhereNoDescriptorIsLeftUntilThereIsOne) {
  const HttpServer server = start();
  ::rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  std::vector<files::OwnedDescriptor> all;
  ::rlimit few = before;
  few.rlim_cur = open_descriptors() + 1;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  // Of what is left, one goes to the client that knocks.
  for (;;) {
    files::OwnedDescriptor next(::dup(0));
    if (!next) break;
    all.push_back(std::move(next));
  }
  ASSERT_FALSE(all.empty());
  all.pop_back();
  const auto began = Clock::now();
  HttpClient client(server.port());
  ASSERT_TRUE(client.is_connected());
  client.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  while (server.figures().failures < 5) std::this_thread::yield();
  const auto rounds = (Clock::now() - began) / milliseconds(50);
  EXPECT_LE(server.figures().failures, static_cast<std::uint64_t>(rounds) + 1) << "it spins";
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_THAT(client.rest(), HasSubstr("a word"));
}

TEST(HttpServer, TakesInSoManyConnectionsASecond) {
  const HttpServer server = start({.connections_a_second = 20});
  const auto began = Clock::now();
  for (int i = 0; i < 40; ++i) EXPECT_EQ(get(server.port(), "/").status, 200);
  EXPECT_GT(Clock::now() - began, milliseconds(500)) << "20 may come at once, not 40";
}

TEST(HttpServer, ReadsSoMuchASecondOfAConnection) {
  const HttpServer server = start({.bytes_a_second = 500});
  const std::string body(2'000, 'x');
  const auto began = Clock::now();
  EXPECT_EQ(ask(server.port(), "POST", "/echo", {}, body).body, body);
  EXPECT_GT(Clock::now() - began, milliseconds(900));
}

TEST(HttpServer, TurnsAwayMoreGuestsThanItServes) {
  const HttpServer server = start({.guests = 2, .stall_time = std::chrono::hours(1)});
  HttpClient first(server.port(), 4096), second(server.port(), 4096);
  ask_for_flood(first);
  ask_for_flood(second);
  EXPECT_EQ(get(server.port(), "/flood").status, 503);
  EXPECT_EQ(get(server.port(), "/").status, 200);
}

TEST(HttpServer, DisconnectsAGuestThatTakesNothingAndServesTheNext) {
  const HttpServer server = start({.guests = 1, .stall_time = milliseconds(300)});
  HttpClient stopped(server.port(), 4096);
  ask_for_flood(stopped);
  while (server.figures().stalled < 1) std::this_thread::yield();
  EXPECT_LT(stopped.rest().size(), 64'000'000U);
  HttpClient next(server.port(), 4096);
  ask_for_flood(next);
}

TEST(HttpServer, GoesOnWhereAnAnswerCannotBeMade) {
  const HttpServer server = start();
  EXPECT_EQ(get(server.port(), "/fail").status, 500);
  EXPECT_EQ(server.figures().failures, 1U);
  EXPECT_EQ(get(server.port(), "/").status, 200);
}

TEST(HttpServer, RefusesOtherNamesAndHeadersThatDecideAndComeTwice) {
  const HttpServer server = start();
  EXPECT_EQ(get(server.port(), "/", "Host: evil.example\r\n").status, 403);
  for (const char* twice :
       {"Host: localhost\r\nHost: evil.example\r\n", "Host: localhost\r\nhost: localhost\r\n",
        "Origin: http://localhost\r\nOrigin: http://evil.example\r\n",
        "Sec-Fetch-Site: none\r\nSec-Fetch-Site: cross-site\r\n"}) {
    EXPECT_EQ(get(server.port(), "/", twice).status, 400) << twice;
  }
  EXPECT_EQ(get(server.port(), "http://evil.example/").status, 400);
  EXPECT_EQ(server.figures().refused, 6U);
}

TEST(HttpServer, DoesNotStartWhereNoThreadIsLeftAndSaysSo) {
  const test::NoThreads none;
  const auto server = HttpServer::start({.at = {INADDR_LOOPBACK, 0}, .what = "words"}, answer);
  ASSERT_FALSE(server);
  EXPECT_EQ(server.error().code, ErrorCode::kCapacityExceeded);
  EXPECT_THAT(server.error().message, HasSubstr("cannot serve words on 127.0.0.1:0"));
  EXPECT_THAT(server.error().message, HasSubstr("ulimit -u"));
}

TEST(HttpServer, EndsThoughClientsStay) {
  std::optional<HttpServer> server(start());
  const std::uint16_t port = server->port();
  HttpClient silent(port), flooded(port, 4096);
  ask_for_flood(flooded);
  server.reset();
  EXPECT_TRUE(silent.is_hung_up_on());
  EXPECT_FALSE(HttpClient(port).is_connected());
}

}  // namespace
}  // namespace terracut::cli
