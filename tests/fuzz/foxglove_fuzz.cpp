// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What a viewer, or whoever poses as one, sends: a text, and its headers. Nothing crashes, and what
// is understood is within the text.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tools/cli/foxglove/playback.hpp"
#include "tools/cli/foxglove/protocol.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto request = terracut::cli::parse_foxglove_request(text);
  // A subscription takes more than ten characters.
  if (request && request->subscribe.size() * 10 > size) std::abort();
  const auto playback = terracut::cli::parse_playback_request(text, 1'700'000'000'000'000'000);
  if (playback && !(*playback->command.rate > 0 && playback->command.seek_s.value_or(0) >= 0)) {
    std::abort();
  }
  const std::string_view protocol = terracut::cli::foxglove_sub_protocol(text);
  if (!protocol.empty() && text.find(protocol) == std::string_view::npos) std::abort();
  (void)terracut::cli::is_allowed_origin(text, text, "vehicle", {"https://app.foxglove.dev"});
  (void)terracut::cli::warning_text(text);
  return 0;
}
