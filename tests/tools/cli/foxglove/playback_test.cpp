// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/foxglove/playback.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

#include "tools/cli/foxglove/protocol.hpp"

namespace terracut::cli {
namespace {

constexpr std::int64_t kBegin_ns = 1'700'000'000'000'000'000;

/// As foxglove-sdk 0.25 lays it out.
std::string request(std::uint8_t command, float speed, bool seeks, std::uint64_t to_ns,
                    std::string_view id) {
  std::string bytes;
  const auto append = [&](auto number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  append(std::uint8_t{3});
  append(command);
  append(speed);
  append(static_cast<std::uint8_t>(seeks ? 1 : 0));
  append(to_ns);
  append(static_cast<std::uint32_t>(id.size()));
  return bytes.append(id);
}

TEST(FoxglovePlayback, RequestsAreAPlayersCommands) {
  const auto seek =
      parse_playback_request(request(1, 1, true, kBegin_ns + 2'500'000'000, "a"), kBegin_ns);
  ASSERT_TRUE(seek);
  EXPECT_EQ(seek->id, "a");
  EXPECT_EQ(seek->command.playing, false);
  EXPECT_NEAR(seek->command.seek_s.value(), 2.5, 1e-6);
  const auto on = parse_playback_request(request(0, 2, false, 7, ""), kBegin_ns);
  ASSERT_TRUE(on);
  EXPECT_EQ(on->command.playing, true);
  EXPECT_EQ(on->command.rate, 2);
  EXPECT_FALSE(on->command.seek_s);
}

TEST(FoxglovePlayback, PlacesAndSpeedsOutsideGoToTheNearestThatThereIs) {
  const auto before = parse_playback_request(request(0, 100, true, 0, "a"), kBegin_ns);
  ASSERT_TRUE(before);
  EXPECT_EQ(before->command.seek_s, 0);
  EXPECT_EQ(before->command.rate, kMostRate);
  const auto after = parse_playback_request(
      request(0, 0.001F, true, std::numeric_limits<std::uint64_t>::max(), "a"), kBegin_ns);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->command.rate, kLeastRate);
  EXPECT_EQ(after->command.seek_s, kLongestSeek_s);
}

TEST(FoxglovePlayback, WhatIsNoRequestIsRefused) {
  const std::string good = request(0, 1, false, 0, "id");
  for (std::size_t bytes = 0; bytes < good.size(); ++bytes) {
    EXPECT_FALSE(parse_playback_request(good.substr(0, bytes), kBegin_ns)) << bytes;
  }
  EXPECT_FALSE(parse_playback_request(good + "x", kBegin_ns));
  EXPECT_FALSE(parse_playback_request(request(2, 1, false, 0, "id"), kBegin_ns));
  for (const float speed : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity()}) {
    EXPECT_FALSE(parse_playback_request(request(0, speed, false, 0, "id"), kBegin_ns)) << speed;
  }
  EXPECT_EQ(parse_playback_request("\x01"
                                   "data",
                                   kBegin_ns)
                .error()
                .code,
            ErrorCode::kUnsupported);
}

TEST(FoxglovePlayback, StateHasTheDocumentedLayout) {
  PlayerState state{.playing = false, .rate = 2, .position_s = 1.5, .begin_ns = kBegin_ns};
  const std::string bytes = playback_state_message(state, true, "id");
  ASSERT_EQ(bytes.size(), 21U);
  EXPECT_EQ(bytes.substr(0, 2), std::string("\x05\x01"));
  std::uint64_t time_ns = 0;
  std::memcpy(&time_ns, bytes.data() + 2, sizeof time_ns);
  EXPECT_EQ(time_ns, static_cast<std::uint64_t>(kBegin_ns) + 1'500'000'000);
  EXPECT_EQ(bytes.substr(14), std::string("\x01\x02\0\0\0id", 7));
  state.at_end = true;
  EXPECT_EQ(playback_state_message(state, false, {})[1], 3);
}

TEST(FoxglovePlayback, IsOfferedOfCapturesAlone) {
  const PlayerState state{.duration_s = 2, .begin_ns = kBegin_ns};
  const std::string played = server_info_text("a", &state);
  EXPECT_NE(played.find(R"("capabilities":["playbackControl"])"), std::string::npos) << played;
  EXPECT_NE(played.find(R"("dataEndTime":{"nsec":0,"sec":1700000002})"), std::string::npos);
  const std::string live = server_info_text("a", nullptr);
  EXPECT_NE(live.find(R"("capabilities":[])"), std::string::npos) << live;
}

}  // namespace
}  // namespace terracut::cli
