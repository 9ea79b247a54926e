// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "protocol.hpp"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "pipeline/ros_messages/topics.hpp"
#include "tools/cli/http/http_host.hpp"

namespace terracut::cli {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 2> kSubProtocols{"foxglove.sdk.v1", "foxglove.websocket.v1"};

tl::unexpected<Error> malformed(const std::string& what) {
  return fail(ErrorCode::kMalformed, "not understood: " + what);
}

/// Returns `value` as an id of the protocol; nothing if it is none.
std::optional<std::uint32_t> id_in(const Json& value) {
  if (!value.is_number_unsigned()) return std::nullopt;
  const auto id = value.get<std::uint64_t>();
  return id <= UINT32_MAX ? std::optional(static_cast<std::uint32_t>(id)) : std::nullopt;
}

/// Returns a member of an object, null if it is missing.
const Json& member(const Json& object, const char* key) {
  static const Json kNone;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found == object.end() ? kNone : *found;
}

Json time_of(std::int64_t time_ns) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  return {{"sec", time_ns / kSecond_ns}, {"nsec", time_ns % kSecond_ns}};
}

}  // namespace

std::string_view foxglove_sub_protocol(std::string_view offered) {
  for (const std::string_view known : kSubProtocols) {
    for (std::string_view rest = offered; !rest.empty();) {
      const std::size_t comma = rest.find(',');
      std::string_view word = rest.substr(0, comma);
      rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
      while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
      while (!word.empty() && word.back() == ' ') word.remove_suffix(1);
      if (word == known) return known;
    }
  }
  return {};
}

std::string server_info_text(const std::string& name, const PlayerState* capture) {
  Json info{{"op", "serverInfo"},
            {"name", name},
            {"capabilities", Json::array()},
            {"supportedEncodings", {"cdr"}},
            {"metadata", Json::object()}};
  if (capture != nullptr) {
    info["capabilities"].push_back("playbackControl");
    info["dataStartTime"] = time_of(capture->begin_ns);
    info["dataEndTime"] =
        time_of(capture->begin_ns + static_cast<std::int64_t>(capture->duration_s * 1e9));
  }
  return info.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string advertise_text(const std::vector<bool>& wanted) {
  Json channels = Json::array();
  for (std::size_t i = 0; i < ros_messages::kTopics.size(); ++i) {
    if (!wanted[i]) continue;
    const ros_messages::Topic& topic = ros_messages::kTopics[i];
    channels.push_back({{"id", kFirstChannelId + i},
                        {"topic", topic.name},
                        {"encoding", "cdr"},
                        {"schemaName", topic.schema.type},
                        {"schema", topic.schema.definition},
                        {"schemaEncoding", "ros2msg"}});
  }
  return Json{{"op", "advertise"}, {"channels", std::move(channels)}}.dump();
}

std::string warning_text(std::string_view message) {
  return Json{{"op", "status"}, {"level", 1}, {"message", message}}.dump(
      -1, ' ', false, Json::error_handler_t::replace);
}

Expected<FoxgloveRequest> parse_foxglove_request(std::string_view text) {
  const Json request = Json::parse(text, nullptr, false);
  const Json& op = member(request, "op");
  if (!op.is_string()) return malformed("expected a JSON object with an \"op\"");
  FoxgloveRequest understood;
  if (op == "subscribe") {
    const Json& subscriptions = member(request, "subscriptions");
    if (!subscriptions.is_array()) return malformed("subscribe without \"subscriptions\"");
    for (const Json& each : subscriptions) {
      const auto id = id_in(member(each, "id")), channel = id_in(member(each, "channelId"));
      if (!id || !channel) return malformed("a subscription has an \"id\" and a \"channelId\"");
      understood.subscribe.push_back({*id, *channel});
    }
    return understood;
  }
  if (op == "unsubscribe") {
    const Json& ids = member(request, "subscriptionIds");
    if (!ids.is_array()) return malformed("unsubscribe without \"subscriptionIds\"");
    for (const Json& each : ids) {
      const auto id = id_in(each);
      if (!id) return malformed("an id is a whole number");
      understood.unsubscribe.push_back(*id);
    }
    return understood;
  }
  return fail(ErrorCode::kUnsupported, "not offered here: " + op.get<std::string>().substr(0, 40));
}

std::array<std::byte, 13> message_data_header(std::uint32_t subscription_id,
                                              std::uint64_t log_time_ns) noexcept {
  std::array<std::byte, 13> header{std::byte{1}};
  std::memcpy(header.data() + 1, &subscription_id, sizeof subscription_id);
  std::memcpy(header.data() + 5, &log_time_ns, sizeof log_time_ns);
  return header;
}

bool is_allowed_origin(std::string_view origin, std::string_view user_agent,
                       std::string_view own_name, const std::vector<std::string>& allowed) {
  if (origin.empty() || std::ranges::find(allowed, origin) != allowed.end()) return true;
  // The desktop programs of Foxglove and Lichtblick are based on Electron.
  if (origin == "file://") return user_agent.find(" Electron/") != std::string_view::npos;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!origin.starts_with(scheme)) continue;
    const std::string_view host = origin.substr(scheme.size());
    if (host.empty()) return false;
    // Only numeric loopback addresses are accepted: a page from another machine's address is
    // foreign.
    return host.starts_with("127.") || host.starts_with("[::1]")
               ? names_this_machine(host, {})
               : host.find_first_not_of("0123456789.:[]") != std::string_view::npos &&
                     names_this_machine(host, own_name);
  }
  return false;
}

}  // namespace terracut::cli
