// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "playback.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace terracut::cli {
namespace {

constexpr std::uint8_t kPlaybackControlRequest = 3, kPlaybackState = 5;  // operation codes
constexpr std::uint8_t kPlay = 0, kPause = 1;
constexpr std::uint8_t kIsPlaying = 0, kIsPaused = 1, kHasEnded = 3;

/// The bytes before the id: code, command, speed, seek flag, seek time, length of the id.
constexpr std::size_t kRequestBytes = 1 + 1 + 4 + 1 + 8 + 4;

template <class Number>
Number number_at(std::string_view bytes, std::size_t at) {
  static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

template <class Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

tl::unexpected<Error> malformed(const char* what) {
  return fail(ErrorCode::kMalformed, std::string("not understood: ") + what);
}

}  // namespace

Expected<PlaybackRequest> parse_playback_request(std::string_view bytes, std::int64_t begin_ns) {
  if (bytes.empty() || number_at<std::uint8_t>(bytes, 0) != kPlaybackControlRequest) {
    return fail(ErrorCode::kUnsupported, "not offered here: a binary message of this kind");
  }
  if (bytes.size() < kRequestBytes) return malformed("a playback request that is cut short");
  const auto command = number_at<std::uint8_t>(bytes, 1);
  const auto speed = number_at<float>(bytes, 2);
  const auto id_bytes = number_at<std::uint32_t>(bytes, kRequestBytes - 4);
  if (command != kPlay && command != kPause) return malformed("an unknown playback command");
  if (!(speed > 0) || !std::isfinite(speed)) return malformed("a playback speed that is none");
  if (bytes.size() - kRequestBytes != id_bytes) return malformed("an id of another length");
  PlaybackRequest request;
  request.command.playing = command == kPlay;
  request.command.rate = std::clamp(double{speed}, kLeastRate, kMostRate);
  if (number_at<std::uint8_t>(bytes, 6) != 0) {
    const auto to_ns = static_cast<double>(number_at<std::uint64_t>(bytes, 7));
    const double seek_s = (to_ns - static_cast<double>(begin_ns)) * 1e-9;
    request.command.seek_s = std::clamp(seek_s, 0.0, kLongestSeek_s);
  }
  request.id = bytes.substr(kRequestBytes);
  return request;
}

std::string playback_state_message(const PlayerState& state, bool did_seek,
                                   std::string_view request_id) {
  const auto position_ns = static_cast<std::int64_t>(state.position_s * 1e9);
  std::string bytes;
  append(bytes, kPlaybackState);
  append(bytes, state.at_end ? kHasEnded : state.playing ? kIsPlaying : kIsPaused);
  append(bytes, static_cast<std::uint64_t>(state.begin_ns + position_ns));
  append(bytes, static_cast<float>(state.rate));
  append(bytes, static_cast<std::uint8_t>(did_seek ? 1 : 0));
  append(bytes, static_cast<std::uint32_t>(request_id.size()));
  return bytes.append(request_id);
}

}  // namespace terracut::cli
