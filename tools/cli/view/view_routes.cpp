// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "view_routes.hpp"

#include <httplib.h>

#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "tools/cli/export/http_host.hpp"
#include "tools/cli/json_text.hpp"
#include "view_page.hpp"

namespace terracut::cli {
namespace {

using httplib::Request;
using httplib::Response;

constexpr const char* kText = "text/plain; charset=utf-8";
constexpr std::chrono::milliseconds kPatience{100};

void refuse(Response& response, int status, const std::string& words) {
  response.status = status;
  response.set_content(words + "\n", kText);
}

std::string figures_text(const ViewSource& source) {
  nlohmann::ordered_json json = source.frames.figures();
  json["browsers"] = {{"looking", source.streams.load()},
                      {"sent", source.sent.load()},
                      {"skipped", source.skipped.load()}};
  json["capture"] = nullptr;
  if (source.capture != nullptr) {
    const PlayerState state = source.capture->state();
    json["capture"] = {{"playing", state.playing},
                       {"rate", state.rate},
                       {"position_s", state.position_s},
                       {"duration_s", state.duration_s},
                       {"frame_s", state.frame_s}};
  }
  return json_text(json);
}

/// One browser's way through the frames.
class FrameStream {
 public:
  explicit FrameStream(ViewSource& source) : source_(source) {}
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;
  ~FrameStream() { --source_.streams; }

  /// False when the browser is gone.
  bool send_next(httplib::DataSink& sink) {
    const ViewFrames::Turn turn = source_.frames.newer(seen_, kPatience);
    if (source_.is_over) {
      sink.done();
      return true;
    }
    if (!turn.frame) return sink.is_writable();
    const std::uint64_t skipped = seen_ == 0 ? 0 : turn.number - seen_ - 1;
    source_.skipped += skipped;
    missed_ += static_cast<std::uint32_t>(skipped);
    seen_ = turn.number;
    stream::FrameWireHeader header = turn.frame->header;
    header.missed = missed_;
    const auto points = std::as_bytes(std::span(turn.frame->points));
    if (!sink.write(reinterpret_cast<const char*>(&header), sizeof(header)) ||
        !sink.write(reinterpret_cast<const char*>(points.data()), points.size())) {
      return false;
    }
    ++source_.sent;
    return true;
  }

 private:
  ViewSource& source_;
  std::uint64_t seen_ = 0;
  std::uint32_t missed_ = 0;
};

void answer_frames(ViewSource& source, Response& response) {
  if (++source.streams > kMostViewers) {
    --source.streams;
    return refuse(response, 503, "as many browsers look at the frames as may; close one of them");
  }
  auto stream = std::make_shared<FrameStream>(source);
  response.set_header("Cache-Control", "no-store");
  response.set_chunked_content_provider(
      "application/octet-stream",
      [stream](std::size_t, httplib::DataSink& sink) { return stream->send_next(sink); });
}

void answer_control(ViewSource& source, const Request& request, Response& response) {
  if (source.capture == nullptr) return refuse(response, 409, "a live run cannot be played");
  const auto command = parse_player_command(request.body);
  if (!command) return refuse(response, 400, command.error().message);
  source.capture->obey(*command);
  response.set_content(figures_text(source), "application/json");
}

}  // namespace

bool is_own_origin(std::string_view origin, std::string_view host) {
  if (origin.empty()) return true;
  constexpr std::string_view kScheme = "http://";
  return origin.starts_with(kScheme) && origin.substr(kScheme.size()) == host;
}

void route_view(httplib::Server& server, ViewSource& source) {
  server.set_pre_routing_handler(
      [name = own_host_name()](const Request& request, Response& response) {
        using Handling = httplib::Server::HandlerResponse;
        const std::string host = request.get_header_value("Host");
        if (!names_this_machine(host, name)) {
          refuse(response, 403, "ask by this machine's address, as localhost or as '" + name + "'");
          return Handling::Handled;
        }
        if (!is_own_origin(request.get_header_value("Origin"), host)) {
          refuse(response, 403, "pages of other origins may not ask");
          return Handling::Handled;
        }
        // The page is complete in itself, and shows itself in no other.
        response.set_header("Content-Security-Policy",
                            "default-src 'self'; img-src 'self' data:; frame-ancestors 'none'");
        response.set_header("X-Content-Type-Options", "nosniff");
        return Handling::Unhandled;
      });
  for (const PageFile& file : view_page()) {
    server.Get(std::string(file.path), [&file](const Request&, Response& response) {
      response.set_header("Cache-Control", "no-cache");
      response.set_content(file.text.data(), file.text.size(), std::string(file.type).c_str());
    });
  }
  server.Get("/frames",
             [&source](const Request&, Response& response) { answer_frames(source, response); });
  server.Get("/figures", [&source](const Request&, Response& response) {
    response.set_header("Cache-Control", "no-store");
    response.set_content(figures_text(source), "application/json");
  });
  server.Post("/control", [&source](const Request& request, Response& response) {
    answer_control(source, request, response);
  });
}

}  // namespace terracut::cli
