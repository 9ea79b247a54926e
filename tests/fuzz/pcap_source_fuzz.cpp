// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Any bytes as a capture file: no crash, no read outside the file, no endless loop, every frame
// accounted for. Aborts when one of these does not hold.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "firmware_io/capture/capture_source.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terracut;
  auto source = capture::CaptureSource::open_memory({data, size}, "fuzz");
  if (!source) {
    if (source.error().message.empty()) std::abort();
    return 0;
  }
  unsigned touched = 0;
  for (auto next = source->next(); next && *next; next = source->next()) {
    for (const std::uint8_t byte : (*next)->payload) touched += byte;
  }
  const capture::CaptureCounters& counters = source->counters();
  const bool all_counted =
      counters.frames == counters.delivered + counters.joined + counters.refused_total();
  if (!all_counted) std::abort();
  // A record takes at least its header, so a file cannot hold more frames than bytes.
  if (counters.frames > size) std::abort();
  return touched == ~0U ? 1 : 0;
}
