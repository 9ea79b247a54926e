// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "firmware_io/capture/capture_source.hpp"
#include "tests/support/reference/rotating_head.hpp"

namespace terracut::test {

/// The payloads of a capture, of one port or of all; none if it cannot be opened.
inline std::vector<reference::Payload> payloads_of(const std::filesystem::path& path,
                                                   std::optional<std::uint16_t> port = {}) {
  std::vector<reference::Payload> payloads;
  auto source = capture::CaptureSource::open(path, {.port = port});
  if (!source) return payloads;
  for (auto next = source->next(); next && *next; next = source->next()) {
    payloads.push_back({{(*next)->payload.begin(), (*next)->payload.end()}, (*next)->stamp_ns});
  }
  return payloads;
}

}  // namespace terracut::test
