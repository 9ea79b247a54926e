// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "http_server.hpp"

#include "http_connection.hpp"
// This line keeps clang-format from sorting the first include below into the block above.
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

#include "http_host.hpp"

namespace terracut::cli {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;
using tcp = asio::ip::tcp;
using Clock = HttpPace::Clock;

constexpr std::chrono::milliseconds kRound{100};
constexpr int kBacklog = 64;
/// The connections allowed in this many seconds may all come at once.
constexpr int kBurst_s = 1;

std::string_view field(const http::fields& fields, std::string_view name) {
  const auto found = fields.find({name.data(), name.size()});
  if (found == fields.end()) return {};
  return {found->value().data(), found->value().size()};
}

/// Headers on which the check of a request depends, so each may occur only once.
constexpr std::array<std::string_view, 5> kSaidOnce{"Host", "Origin", "Sec-Fetch-Site",
                                                    "Sec-Fetch-Mode", "X-Terracut-Page"};

bool is_said_twice(const http::fields& fields) {
  return std::ranges::any_of(kSaidOnce, [&](std::string_view name) {
    return fields.count({name.data(), name.size()}) > 1;
  });
}

HttpRequest told(const http::request<http::string_body>& request) {
  const std::string_view target(request.target().data(), request.target().size());
  const std::string_view method(request.method_string().data(), request.method_string().size());
  return {.method = method == "HEAD" ? "GET" : method,
          .path = target.substr(0, target.find('?')),
          .body = request.body(),
          .host = field(request, "Host"),
          .origin = field(request, "Origin"),
          .user_agent = field(request, "User-Agent"),
          .sub_protocols = field(request, "Sec-WebSocket-Protocol"),
          .fetch_site = field(request, "Sec-Fetch-Site"),
          .fetch_mode = field(request, "Sec-Fetch-Mode"),
          .page = field(request, "X-Terracut-Page")};
}

/// State shared by all connections being answered; used on the server's thread, except for the
/// figures.
struct Shared {
  HttpServer::Config config;
  HttpResponder respond;
  std::string own_name = own_host_name();
  HttpServer::Figures figures{};
  std::vector<std::weak_ptr<HttpGuest>> guests{};
};

/// Handles a connection from its first byte to its answer.
class Visit : public std::enable_shared_from_this<Visit> {
 public:
  Visit(tcp::socket socket, Shared& shared)
      : stream_(HttpPace(shared.config.bounds.bytes_a_second), std::move(socket)),
        shared_(shared),
        due_(Clock::now() + shared.config.bounds.visit_time) {}
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;
  ~Visit() {
    if (!is_accounted_) ++shared_.figures.refused;
  }

  void begin() {
    parser_.header_limit(HttpBounds::kHeaderBytes);
    parser_.body_limit(HttpBounds::kBodyBytes);
    http::async_read_header(stream_, buffer_, parser_,
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (error) return self->give_up(error);
                              self->read_body();
                            });
  }

  void close() { stream_.close(); }
  [[nodiscard]] Clock::time_point due() const noexcept { return due_; }

 private:
  void read_body() {
    if (parser_.chunked()) return answer(http_refusal(411, "say how long the body is"));
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](error_code error, std::size_t) {
                       if (error) return self->give_up(error);
                       self->reply();
                     });
  }

  void give_up(error_code error) {
    if (error == http::error::body_limit) return answer(http_refusal(413, "the body is too long"));
    if (error == http::error::header_limit || error == http::error::buffer_overflow) {
      return answer(http_refusal(431, "the headers are too long"));
    }
    // A client that sends nothing only wanted to know whether somebody listens.
    if (error == http::error::end_of_stream) is_accounted_ = true;
    if (error.category() == make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream && error != http::error::partial_message) {
      answer(http_refusal(400, "not understood as HTTP/1.1"));
    }
  }

  void reply() {
    const HttpRequest request = told(parser_.get());
    if (is_said_twice(parser_.get())) {
      return answer(http_refusal(400, "a header that decides on the answer comes twice"));
    }
    if (!request.path.starts_with('/')) return answer(http_refusal(400, "expected a path"));
    if (!names_this_machine(request.host, shared_.own_name)) {
      return answer(http_refusal(
          403, "ask by this machine's address, as localhost or as '" + shared_.own_name + "'"));
    }
    HttpReply reply = http_refusal(500, "");
    try {
      reply = shared_.respond(request);
    } catch (const std::exception&) {
      ++shared_.figures.failures;
    }
    if (auto* const takeover = std::get_if<HttpTakeover>(&reply)) return take_over(*takeover);
    answer(std::get<HttpAnswer>(std::move(reply)));
  }

  void take_over(const HttpTakeover& takeover) {
    if (parser_.get().method() == http::verb::head)
      return answer(http_refusal(405, "expected GET"));
    std::erase_if(shared_.guests, [](const auto& guest) { return guest.expired(); });
    if (shared_.guests.size() >= shared_.config.bounds.guests) {
      return answer(http_refusal(503, "as many are looking as may; close one of them"));
    }
    is_accounted_ = true;
    shared_.guests.push_back(takeover({std::move(stream_), parser_.release()}));
  }

  void answer(HttpAnswer answer) {
    is_accounted_ = true;
    // A 404 does not count as a refusal: browsers ask by themselves for files that may be missing.
    if (answer.status >= 400 && answer.status != 404) ++shared_.figures.refused;
    response_.result(static_cast<unsigned>(answer.status));
    response_.version(11);
    response_.set(http::field::content_type, {answer.type.data(), answer.type.size()});
    response_.set(http::field::cache_control, "no-store");
    response_.set(http::field::connection, "close");
    response_.set("X-Content-Type-Options", "nosniff");
    // Our pages load nothing from other sites and must not be embedded in their pages.
    response_.set("Content-Security-Policy",
                  "default-src 'self'; img-src 'self' data:; frame-ancestors 'none'");
    response_.body() = std::move(answer.body);
    response_.prepare_payload();
    if (parser_.get().method() == http::verb::head) response_.body().clear();
    http::async_write(stream_, response_,
                      [self = shared_from_this()](error_code error, std::size_t) {
                        if (!error) self->take_leave();
                      });
  }

  /// Reads the rest of the request: closing at once could discard the answer before the client has
  /// read it.
  void take_leave() {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    if (!parser_.is_done()) drain();
  }
  void drain() {
    stream_.async_read_some(asio::buffer(drained_),
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (!error) self->drain();
                            });
  }

  HttpStream stream_;
  Shared& shared_;
  Clock::time_point due_;
  bool is_accounted_ = false;
  beast::flat_buffer buffer_{HttpBounds::kHeaderBytes + HttpBounds::kBodyBytes};
  http::request_parser<http::string_body> parser_;
  http::response<http::string_body> response_;
  std::array<char, 1024> drained_;
};

tl::unexpected<Error> cannot_serve(const HttpServer::Config& config, ErrorCode code,
                                   const std::string& reason, const char* advice) {
  return fail(code, fmt::format("cannot serve {} on {}: {}; {}", config.what, to_string(config.at),
                                reason, advice));
}

}  // namespace

struct HttpServer::State {
  State(const Config& config, HttpResponder respond)
      : shared{.config = config, .respond = std::move(respond)} {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    is_over = true;
    context.stop();
  }

  error_code listen() {
    const tcp::endpoint at(asio::ip::address_v4(shared.config.at.address), shared.config.at.port);
    error_code error;
    acceptor.open(at.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(at, error);
    if (!error) acceptor.listen(kBacklog, error);
    return error;
  }

  void serve() noexcept {
    while (!is_over) {
      try {
        context.restart();
        context.run_for(kRound);
        work_round();
      } catch (const std::exception&) {
        ++shared.figures.failures;
      }
    }
  }

  void work_round() {
    const auto now = Clock::now();
    // After an exception the loop begins anew, so this check keeps rounds from following too soon.
    if (now - last_round < kRound / 2) return;
    last_round = now;
    const HttpBounds& bounds = shared.config.bounds;
    const int a_round = std::max(1, bounds.connections_a_second / 10);
    admissions = std::min(admissions + a_round, kBurst_s * bounds.connections_a_second);
    accept();
    for (const auto& each : visits) {
      const auto visit = each.lock();
      if (visit && visit->due() <= now) visit->close();
    }
    for (const auto& each : shared.guests) {
      const auto guest = each.lock();
      if (!guest) continue;
      const auto stands_since = guest->stream().rate_policy().stands_since();
      if (stands_since && now - *stands_since > bounds.stall_time) {
        ++shared.figures.stalled;
        guest->stream().close();
      } else {
        guest->work_round();
      }
    }
  }

  /// Accepts connections. If no more are allowed, or accepting fails, waits for the next round: the
  /// pending connection would keep this thread busy.
  void accept() {
    if (is_accepting || admissions == 0) return;
    acceptor.async_accept([this](error_code error, tcp::socket socket) {
      is_accepting = false;
      if (error) {
        if (error != asio::error::operation_aborted) ++shared.figures.failures;
        return;
      }
      --admissions;
      let_in(std::move(socket));
      accept();
    });
    is_accepting = true;
  }

  void let_in(tcp::socket socket) {
    std::erase_if(visits, [](const auto& visit) { return visit.expired(); });
    if (visits.size() >= shared.config.bounds.visits) {
      visits.front().lock()->close();
      visits.pop_front();
    }
    const auto visit = std::make_shared<Visit>(std::move(socket), shared);
    visits.push_back(visit);
    visit->begin();
  }

  Shared shared;
  asio::io_context context{1};
  asio::executor_work_guard<asio::io_context::executor_type> always{context.get_executor()};
  tcp::acceptor acceptor{context};
  std::deque<std::weak_ptr<Visit>> visits;  ///< Oldest first.
  int admissions = kBurst_s * shared.config.bounds.connections_a_second;
  bool is_accepting = false;
  Clock::time_point last_round{};
  std::atomic<bool> is_over{false};
  std::jthread thread;  ///< Declared last, as it uses all of the above.
};

HttpServer::HttpServer(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
HttpServer::HttpServer(HttpServer&&) noexcept = default;
HttpServer::~HttpServer() = default;

Expected<HttpServer> HttpServer::start(const Config& config, HttpResponder respond) {
  try {
    auto state = std::make_unique<State>(config, std::move(respond));
    if (const error_code error = state->listen()) {
      return cannot_serve(config, ErrorCode::kInvalidArgument, error.message(),
                          "choose another address or port");
    }
    state->accept();
    state->thread = std::jthread([raw = state.get()] { raw->serve(); });
    return HttpServer(std::move(state));
  } catch (const std::system_error& error) {
    return cannot_serve(
        config, ErrorCode::kCapacityExceeded, error.what(),
        "the process needs more than its limits let it have (ulimit -u, -n, -v, or its "
        "container's)");
  }
}

std::uint16_t HttpServer::port() const noexcept {
  error_code ignored;
  return state_->acceptor.local_endpoint(ignored).port();
}

const HttpServer::Figures& HttpServer::figures() const noexcept {
  return state_->shared.figures;
}

void HttpServer::post(std::function<void()> work) {
  asio::post(state_->context, std::move(work));
}

void HttpServer::for_each_guest(std::function<void(HttpGuest&)> work) {
  post([state = state_.get(), work = std::move(work)] {
    for (const auto& each : state->shared.guests) {
      if (const auto guest = each.lock()) work(*guest);
    }
  });
}

}  // namespace terracut::cli
