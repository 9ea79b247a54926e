// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "view_routes.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "frame_stream.hpp"
#include "tools/cli/http/http_host.hpp"
#include "tools/cli/json_text.hpp"
#include "view_page.hpp"

namespace terracut::cli {
namespace {

HttpAnswer figures_of(const ViewSource& source) {
  nlohmann::ordered_json json = source.frames.figures();
  json["browsers"] = {{"looking", source.streams.load()},
                      {"sent", source.sent.load()},
                      {"skipped", source.skipped.load()},
                      {"sectors_skipped", source.sectors_skipped.load()}};
  json["capture"] = nullptr;
  if (source.capture != nullptr) {
    const PlayerState state = source.capture->state();
    json["capture"] = {{"playing", state.playing},
                       {"loop", state.loop},
                       {"rate", state.rate},
                       {"seeking", state.seeking},
                       {"frame", state.frame},
                       {"position_s", state.position_s},
                       {"duration_s", state.duration_s},
                       {"frame_s", state.frame_s}};
  }
  return {.body = json_text(json), .type = "application/json"};
}

constexpr std::string_view kFound = "/found/";  // and the frame's number

HttpAnswer found_in(const ViewSource& source, std::string_view number) {
  std::uint32_t frame = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), frame);
  if (error != std::errc() || end != number.data() + number.size()) {
    return http_refusal(404, "expected the number of a frame");
  }
  return {.body = json_text(source.frames.found(frame)), .type = "application/json"};
}

HttpAnswer answer_control(ViewSource& source, std::string_view body) {
  if (source.capture == nullptr) return http_refusal(409, "a live run cannot be played");
  const auto command = parse_player_command(body);
  if (!command) return http_refusal(400, command.error().message);
  source.capture->obey(*command);
  return figures_of(source);
}

HttpReply answer_frames(ViewSource& source, const HttpRequest& asked, Streamed what) {
  if (!is_asked_by_own_page_or_program(asked)) {
    return http_refusal(403, "browsers get frames by way of the page");
  }
  return HttpTakeover([&source, what](HttpConnection&& connection) {
    auto stream = std::make_shared<FrameStream>(std::move(connection.stream), source, what);
    stream->begin();
    return stream;
  });
}

}  // namespace

HttpReply answer_view(ViewSource& source, const HttpRequest& asked) {
  if (is_asked_by_foreign_page(asked)) return http_refusal(403, "pages of others may not ask");
  if (asked.path == "/control") {
    if (asked.method != "POST") return http_refusal(405, "expected POST");
    return answer_control(source, asked.body);
  }
  if (asked.method != "GET") return http_refusal(405, "expected GET");
  if (asked.path == "/frames") return answer_frames(source, asked, Streamed::kFrames);
  const bool by_sectors = source.frames.gives_sectors();
  if (asked.path == "/sectors") {
    return answer_frames(source, asked, by_sectors ? Streamed::kSectors : Streamed::kFrames);
  }
  if (asked.path == "/shown") {
    return answer_frames(source, asked,
                         by_sectors ? Streamed::kSectors : Streamed::kComparedFrames);
  }
  if (asked.path == "/figures") return figures_of(source);
  if (asked.path.starts_with(kFound) && source.frames.finds_anything()) {
    return found_in(source, asked.path.substr(kFound.size()));
  }
  const auto& page = view_page();
  const auto file = std::ranges::find(page, asked.path, &PageFile::path);
  if (file == page.end()) return http_refusal(404, "nothing is here");
  return HttpAnswer{.body = std::string(file->text), .type = file->type};
}

}  // namespace terracut::cli
