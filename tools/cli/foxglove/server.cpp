// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "server.hpp"

#include "tools/cli/http/http_connection.hpp"
// This line keeps clang-format from sorting the first include below into the block above.
#include <boost/beast/websocket.hpp>

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <optional>

#include "pipeline/ros_messages/topics.hpp"
#include "playback.hpp"
#include "protocol.hpp"
#include "tools/cli/http/http_host.hpp"

namespace terracut::cli {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;

constexpr std::size_t kMostTextBytes = 16 << 10;
constexpr std::size_t kMostWaitingTexts = 32;
/// A client that for this long neither answers a ping nor takes a message counts as gone.
constexpr std::chrono::seconds kMostSilence{60};
constexpr std::size_t kTopics = ros_messages::kTopics.size();

/// A message with its time, kept for later subscribers.
struct Kept {
  std::uint64_t time_ns = 0;
  FoxgloveServer::Message message;
};

/// State shared by all clients; used on the server's thread, except for atomics.
struct Shared {
  FoxgloveServer::Config config;
  std::string own_name = own_host_name();
  std::string channels;
  FoxgloveServer::Figures figures;
  std::array<std::atomic<int>, kTopics> subscribers{};
  std::array<std::optional<Kept>, kTopics> kept;
};

/// A viewer, from its handshake on.
class Client final : public HttpGuest, public std::enable_shared_from_this<Client> {
 public:
  Client(HttpStream stream, Shared& shared) : stream_(std::move(stream)), shared_(shared) {}
  ~Client() override {
    for (const auto& [id, topic] : topics_) --shared_.subscribers[topic];
  }

  void begin(const http::request<http::string_body>& request, std::string_view protocol) {
    auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeout.idle_timeout = kMostSilence;
    timeout.keep_alive_pings = true;
    stream_.set_option(timeout);
    stream_.set_option(websocket::stream_base::decorator([protocol](auto& response) {
      response.set(http::field::sec_websocket_protocol, {protocol.data(), protocol.size()});
    }));
    stream_.read_message_max(kMostTextBytes);
    // Sends each message as one WebSocket frame: in fragments of 4 KiB a cloud would take a
    // thousand writes.
    stream_.auto_fragment(false);
    stream_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (error) {
        ++self->shared_.figures.bad_requests;
        return self->stream().close();
      }
      self->greet();
      self->say(self->shared_.channels);
      self->read();
    });
  }

  [[nodiscard]] HttpStream& stream() noexcept override { return stream_.next_layer(); }

  /// Sends the player's state if another client, a browser or the capture's end has changed it.
  void work_round() override {
    if (!speaks_playback_) return;
    const PlayerState state = shared_.config.capture->state();
    if (state.playing == seen_.playing && state.at_end == seen_.at_end && state.rate == seen_.rate)
      return;
    seen_ = state;
    tell_state(state, false, {});
  }

  /// Sends the player's state.
  void tell_state(const PlayerState& state, bool did_seek, std::string_view request_id) {
    if (!speaks_playback_ || outgoing_.size() >= kMostWaitingTexts) return;
    enqueue({.text = playback_state_message(state, did_seek, request_id), .is_binary = true});
  }

  /// Sends the message to each of the client's subscriptions to the topic.
  void offer(std::size_t topic, std::uint64_t time_ns, const FoxgloveServer::Message& message) {
    for (const auto& [id, subscribed] : topics_) {
      if (subscribed == topic) send(id, time_ns, message);
    }
  }

 private:
  struct Outgoing {
    std::string text{};  ///< Sent if `message` is null.
    bool is_binary = false;
    std::optional<std::uint32_t> subscription{};
    std::array<std::byte, 13> header{};
    FoxgloveServer::Message message{};
  };

  void greet() {
    const ViewedCapture* capture = shared_.config.capture;
    const PlayerState state = capture != nullptr ? capture->state() : PlayerState{};
    speaks_playback_ = capture != nullptr && state.begin_ns != 0;
    seen_ = state;
    say(server_info_text(shared_.config.name, speaks_playback_ ? &state : nullptr));
    tell_state(state, false, {});
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) {
        if (error == websocket::error::message_too_big) ++self->shared_.figures.bad_requests;
        return self->stream().close();
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
    if (seeks) {  // answer with the state after the seek
      state.position_s = *request->command.seek_s;
      state.at_end = false;
    }
    tell_state(state, seeks, request->id);
  }

  void subscribe(const FoxgloveRequest::Subscription& wish) {
    // The invalid channel id 0 wraps to a large number.
    const std::size_t topic = wish.channel_id - kFirstChannelId;
    if (topic >= kTopics || !shared_.config.topics[topic]) return complain("no such channel");
    // One subscription per topic is allowed, so that a client that stops reading keeps at most one
    // message of each topic in memory.
    const auto has = [&](const auto& each) {
      return each.first == wish.id || each.second == topic;
    };
    if (std::ranges::any_of(topics_, has)) {
      return complain("there is a subscription of this id or to this channel");
    }
    topics_.emplace(wish.id, topic);
    ++shared_.subscribers[topic];
    if (const auto& kept = shared_.kept[topic]) send(wish.id, kept->time_ns, kept->message);
  }

  void complain(const std::string& what) {
    ++shared_.figures.bad_requests;
    // A client that does not read its answers gets no more of them.
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
      if (error) return self->stream().close();
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

  websocket::stream<HttpStream> stream_;
  Shared& shared_;
  PlayerState seen_;  ///< State that was sent last.
  beast::flat_buffer buffer_{kMostTextBytes};
  std::map<std::uint32_t, std::size_t> topics_;  ///< The key is the subscription's id.
  std::deque<Outgoing> outgoing_;                ///< The first one is being sent.
  bool speaks_playback_ = false;
};

HttpReply answer(Shared& shared, const HttpRequest& asked) {
  if (!is_allowed_origin(asked.origin, asked.user_agent, shared.own_name, shared.config.origins)) {
    return http_refusal(403, "pages of this origin may not connect; --foxglove-origins names more");
  }
  const std::string_view protocol = foxglove_sub_protocol(asked.sub_protocols);
  if (protocol.empty()) {
    return http_refusal(400,
                        "expected Foxglove's WebSocket protocol; open this address in Foxglove or "
                        "Lichtblick");
  }
  return HttpTakeover([&shared, protocol](HttpConnection&& connection) {
    auto client = std::make_shared<Client>(std::move(connection.stream), shared);
    client->begin(connection.request, protocol);
    return client;
  });
}

}  // namespace

struct FoxgloveServer::State {
  explicit State(const Config& config) {
    shared.config = config;
    shared.channels = advertise_text(config.topics);
  }

  Shared shared;
  std::optional<HttpServer> server;  ///< Declared last, as it uses all of the above.
};

FoxgloveServer::FoxgloveServer(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
FoxgloveServer::FoxgloveServer(FoxgloveServer&&) noexcept = default;
FoxgloveServer::~FoxgloveServer() = default;

Expected<FoxgloveServer> FoxgloveServer::start(const Config& config) {
  auto state = std::make_unique<State>(config);
  auto server = HttpServer::start(
      {.at = config.at, .what = "Foxglove", .bounds = config.bounds},
      [&shared = state->shared](const HttpRequest& asked) { return answer(shared, asked); });
  if (!server) return tl::unexpected(server.error());
  state->server.emplace(*std::move(server));
  return FoxgloveServer(std::move(state));
}

std::uint16_t FoxgloveServer::port() const noexcept {
  return state_->server->port();
}

const FoxgloveServer::Figures& FoxgloveServer::figures() const noexcept {
  return state_->shared.figures;
}

const HttpServer::Figures& FoxgloveServer::connections() const noexcept {
  return state_->server->figures();
}

bool FoxgloveServer::is_wanted(std::size_t topic) const noexcept {
  return state_->shared.subscribers[topic] > 0;
}

void FoxgloveServer::publish(std::size_t topic, std::int64_t time_ns, Message message) {
  state_->server->for_each_guest([topic, time_ns, message = std::move(message)](HttpGuest& guest) {
    static_cast<Client&>(guest).offer(topic, static_cast<std::uint64_t>(time_ns), message);
  });
}

void FoxgloveServer::keep(std::size_t topic, std::int64_t time_ns, Message message) {
  state_->server->post([state = state_.get(), topic, time_ns, message = std::move(message)] {
    state->shared.kept[topic] = Kept{static_cast<std::uint64_t>(time_ns), message};
  });
}

}  // namespace terracut::cli
