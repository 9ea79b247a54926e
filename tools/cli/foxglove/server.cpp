// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "server.hpp"

#include <utility>  // before Asio, which forgets it (chriskohlhoff/asio#944)
// A line keeps them apart.
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <optional>
#include <thread>

#include "pipeline/ros_messages/topics.hpp"
#include "playback.hpp"
#include "protocol.hpp"
#include "tools/cli/export/http_host.hpp"

namespace terracut::cli {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using tcp = asio::ip::tcp;

constexpr std::size_t kMostClients = 8;
constexpr std::size_t kMostSubscriptions = 64;
constexpr std::uint32_t kMostHeaderBytes = 8 << 10;
constexpr std::size_t kMostTextBytes = 64 << 10;
constexpr std::size_t kMostWaitingTexts = 32;
constexpr std::chrono::seconds kHandshakePatience{10};
constexpr std::chrono::milliseconds kCaptureWatched{100};
constexpr std::size_t kTopics = ros_messages::kTopics.size();

/// A message with its time, to be sent to those who come later.
struct Kept {
  std::uint64_t time_ns = 0;
  FoxgloveServer::Message message;
};

/// What all clients share; on the server's thread, but for what is atomic.
struct Shared {
  FoxgloveServer::Config config;
  std::string own_name = own_host_name();
  std::string channels;
  FoxgloveServer::Figures figures;
  std::array<std::atomic<int>, kTopics> subscribers{};
  std::array<std::optional<Kept>, kTopics> kept;
};

/// A connection, from its first byte on.
class Client : public std::enable_shared_from_this<Client> {
 public:
  Client(tcp::socket socket, Shared& shared) : stream_(std::move(socket)), shared_(shared) {}
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() {
    for (const auto& [id, topic] : topics_) --shared_.subscribers[topic];
  }

  void begin() {
    beast::get_lowest_layer(stream_).expires_after(kHandshakePatience);
    parser_.header_limit(kMostHeaderBytes);
    parser_.body_limit(0);
    http::async_read_header(stream_.next_layer(), buffer_, parser_,
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (error) {
                                if (error != http::error::end_of_stream)
                                  ++self->shared_.figures.refused;
                                return;
                              }
                              self->shake_hands();
                            });
  }
  void close() {
    error_code ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
  }

  /// Where the capture stands.
  void tell_state(const PlayerState& state, bool did_seek, std::string_view request_id) {
    if (!speaks_playback_ || outgoing_.size() >= kMostWaitingTexts) return;
    enqueue({.text = playback_state_message(state, did_seek, request_id), .is_binary = true});
  }

  /// To each of its subscriptions to the topic that has taken the last one.
  void offer(std::size_t topic, std::uint64_t time_ns, const FoxgloveServer::Message& message) {
    for (const auto& [id, subscribed] : topics_) {
      if (subscribed == topic) send(id, time_ns, message);
    }
  }

 private:
  struct Outgoing {
    std::string text{};  ///< If there is no message.
    bool is_binary = false;
    std::optional<std::uint32_t> subscription{};
    std::array<std::byte, 13> header{};
    FoxgloveServer::Message message{};
  };

  void refuse(http::status status, std::string_view why) {
    ++shared_.figures.refused;
    auto answer = std::make_shared<http::response<http::string_body>>(status, 11);
    answer->set(http::field::content_type, "text/plain");
    answer->body() = std::string(why) + "\n";
    answer->prepare_payload();
    answer->keep_alive(false);
    http::async_write(
        stream_.next_layer(), *answer,
        [self = shared_from_this(), answer](error_code, std::size_t) { self->close(); });
  }

  void shake_hands() {
    const auto& request = parser_.get();
    const auto field = [&](http::field name) {
      const auto value = request[name];
      return std::string_view(value.data(), value.size());
    };
    if (!names_this_machine(field(http::field::host), shared_.own_name) ||
        !is_allowed_origin(field(http::field::origin), shared_.own_name, shared_.config.origins)) {
      return refuse(http::status::forbidden, "Host or Origin is not this machine's");
    }
    const std::string protocol(foxglove_sub_protocol(field(http::field::sec_websocket_protocol)));
    if (!websocket::is_upgrade(request) || protocol.empty()) {
      return refuse(http::status::bad_request,
                    "expected Foxglove's WebSocket protocol; open this address in Foxglove or "
                    "Lichtblick");
    }
    buffer_.clear();  // nothing may come before the answer
    beast::get_lowest_layer(stream_).expires_never();
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    stream_.set_option(websocket::stream_base::decorator([protocol](auto& response) {
      response.set(http::field::sec_websocket_protocol, protocol);
    }));
    stream_.read_message_max(kMostTextBytes);
    // A message is a frame of its own: cut in pieces of 4 KiB, a cloud would be a thousand writes.
    stream_.auto_fragment(false);
    stream_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (error) {
        ++self->shared_.figures.refused;
        return;
      }
      self->greet();
      self->say(self->shared_.channels);
      self->read();
    });
  }

  void greet() {
    const ViewedCapture* capture = shared_.config.capture;
    const PlayerState state = capture != nullptr ? capture->state() : PlayerState{};
    speaks_playback_ = capture != nullptr && state.begin_ns != 0;
    say(server_info_text(shared_.config.name, speaks_playback_ ? &state : nullptr));
    tell_state(state, false, {});
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) {
        if (error == websocket::error::message_too_big) ++self->shared_.figures.bad_requests;
        return;
      }
      const std::string heard = beast::buffers_to_string(self->buffer_.data());
      if (self->stream_.got_binary()) {
        self->play(heard);
      } else {
        self->hear(heard);
      }
      self->buffer_.consume(self->buffer_.size());
      self->read();
    });
  }

  void hear(const std::string& text) {
    const auto request = parse_foxglove_request(text);
    if (!request) return complain(request.error().message);
    for (const auto& wish : request->subscribe) subscribe(wish);
    for (const std::uint32_t id : request->unsubscribe) {
      const auto found = topics_.find(id);
      if (found == topics_.end()) {
        complain("no such subscription");
        continue;
      }
      --shared_.subscribers[found->second];
      topics_.erase(found);
    }
  }

  void play(const std::string& bytes) {
    ViewedCapture* capture = shared_.config.capture;
    if (!speaks_playback_) return complain("not offered here: binary messages");
    PlayerState state = capture->state();
    const auto request = parse_playback_request(bytes, state.begin_ns);
    if (!request) return complain(request.error().message);
    capture->obey(request->command);
    state = capture->state();
    const bool seeks = request->command.seek_s.has_value();
    if (seeks) {  // it will stand there in a moment
      state.position_s = *request->command.seek_s;
      state.at_end = false;
    }
    tell_state(state, seeks, request->id);
  }

  void subscribe(const FoxgloveRequest::Subscription& wish) {
    const std::size_t topic = wish.channel_id - kFirstChannelId;  // wraps to beyond them
    if (topic >= kTopics || !shared_.config.topics[topic]) return complain("no such channel");
    if (topics_.size() >= kMostSubscriptions || topics_.contains(wish.id)) {
      return complain("too many subscriptions, or one of this id");
    }
    topics_.emplace(wish.id, topic);
    ++shared_.subscribers[topic];
    if (const auto& kept = shared_.kept[topic]) send(wish.id, kept->time_ns, kept->message);
  }

  void complain(const std::string& what) {
    ++shared_.figures.bad_requests;
    // Whoever asks without listening to the answers gets no more of them.
    if (outgoing_.size() < kMostWaitingTexts) say(warning_text(what));
  }

  void say(std::string text) { enqueue({.text = std::move(text)}); }

  void send(std::uint32_t id, std::uint64_t time_ns, const FoxgloveServer::Message& message) {
    const auto waits = [&](const Outgoing& each) { return each.subscription == id; };
    if (std::ranges::any_of(outgoing_, waits)) {
      ++shared_.figures.skipped;
      return;
    }
    enqueue({.is_binary = true,
             .subscription = id,
             .header = message_data_header(id, time_ns),
             .message = message});
  }

  void enqueue(Outgoing next) {
    outgoing_.push_back(std::move(next));
    if (outgoing_.size() == 1) write();
  }

  void write() {
    const Outgoing& next = outgoing_.front();
    stream_.binary(next.is_binary);
    const auto written = [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return self->close();
      self->outgoing_.pop_front();
      if (!self->outgoing_.empty()) self->write();
    };
    if (next.message == nullptr) {
      stream_.async_write(asio::buffer(next.text), written);
    } else {
      const std::array<asio::const_buffer, 2> parts{asio::buffer(next.header),
                                                    asio::buffer(*next.message)};
      stream_.async_write(parts, written);
    }
  }

  websocket::stream<beast::tcp_stream> stream_;
  Shared& shared_;
  beast::flat_buffer buffer_{kMostTextBytes + kMostHeaderBytes};
  http::request_parser<http::empty_body> parser_;
  std::map<std::uint32_t, std::size_t> topics_;  ///< By id of the subscription.
  std::deque<Outgoing> outgoing_;                ///< The first one is being written.
  bool speaks_playback_ = false;
};

}  // namespace

struct FoxgloveServer::State {
  explicit State(const Config& config) {
    shared.config = config;
    shared.channels = advertise_text(config.topics);
  }
  ~State() {
    context.stop();
    if (thread.joinable()) thread.join();
  }

  void accept() {
    acceptor.async_accept([this](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      std::erase_if(clients, [](const auto& client) { return client.expired(); });
      if (!error && clients.size() < kMostClients) {
        const auto client = std::make_shared<Client>(std::move(socket), shared);
        clients.push_back(client);
        client->begin();
      } else {
        ++shared.figures.refused;
      }
      accept();
    });
  }

  /// Clients learn what another of them, a browser or the capture's end has changed.
  void watch_capture() {
    timer.expires_after(kCaptureWatched);
    timer.async_wait([this](error_code error) {
      if (error) return;
      const PlayerState state = shared.config.capture->state();
      if (state.playing != seen.playing || state.at_end != seen.at_end || state.rate != seen.rate) {
        seen = state;
        for (const auto& each : clients) {
          if (const auto client = each.lock()) client->tell_state(state, false, {});
        }
      }
      watch_capture();
    });
  }

  Shared shared;
  PlayerState seen;  ///< As clients were told.
  asio::io_context context{1};
  asio::steady_timer timer{context};
  tcp::acceptor acceptor{context};
  std::vector<std::weak_ptr<Client>> clients;
  std::jthread thread;
};

FoxgloveServer::FoxgloveServer(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
FoxgloveServer::FoxgloveServer(FoxgloveServer&&) noexcept = default;
FoxgloveServer::~FoxgloveServer() = default;

Expected<FoxgloveServer> FoxgloveServer::start(const Config& config) {
  auto state = std::make_unique<State>(config);
  const tcp::endpoint at(asio::ip::address_v4(config.at.address), config.at.port);
  error_code error;
  state->acceptor.open(at.protocol(), error);
  if (!error) state->acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) state->acceptor.bind(at, error);
  if (!error) state->acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("cannot serve Foxglove on {}: {}; choose another address",
                            to_string(config.at), error.message()));
  }
  state->accept();
  if (config.capture != nullptr) state->watch_capture();
  state->thread = std::jthread([&context = state->context] { context.run(); });
  return FoxgloveServer(std::move(state));
}

std::uint16_t FoxgloveServer::port() const noexcept {
  error_code ignored;
  return state_->acceptor.local_endpoint(ignored).port();
}

const FoxgloveServer::Figures& FoxgloveServer::figures() const noexcept {
  return state_->shared.figures;
}

bool FoxgloveServer::is_wanted(std::size_t topic) const noexcept {
  return state_->shared.subscribers[topic] > 0;
}

void FoxgloveServer::publish(std::size_t topic, std::int64_t time_ns, Message message) {
  asio::post(state_->context, [state = state_.get(), topic, time_ns, message] {
    for (const auto& each : state->clients) {
      if (const auto client = each.lock()) {
        client->offer(topic, static_cast<std::uint64_t>(time_ns), message);
      }
    }
  });
}

void FoxgloveServer::keep(std::size_t topic, std::int64_t time_ns, Message message) {
  asio::post(state_->context, [state = state_.get(), topic, time_ns, message] {
    state->shared.kept[topic] = Kept{static_cast<std::uint64_t>(time_ns), message};
  });
}

}  // namespace terracut::cli
