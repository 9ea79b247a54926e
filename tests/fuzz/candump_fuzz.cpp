// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Any bytes as a candump log: no crash, no hang, every line counted, and what is taken for a frame
// is one that a log can hold and is read back the same.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>

#include "firmware_io/can/candump_line.hpp"
#include "firmware_io/can/candump_source.hpp"
#include "input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terracut;
  using terracut::fuzz::require;
  can::CandumpSource source(std::make_unique<std::istringstream>(std::string(data, data + size)),
                            "fuzz");
  auto next = source.next();
  for (; next && *next; next = source.next()) {
    const can::CanFrame& frame = **next;
    const std::string line = can::candump_line(frame, "can0");
    const auto again = can::parse_candump_line(std::string_view(line).substr(0, line.size() - 1));
    require(again.has_value(), "a line was written that cannot be read");
    require(again->frame == frame, "a frame is not the same after writing and reading");
  }
  const can::CanLogCounters& counters = source.counters();
  require(counters.records == counters.delivered + counters.no_frame + counters.malformed,
          "not every line is counted");
  require(next.has_value() || counters.delivered == 0, "an error after good frames");
  require(next.has_value() || next.error().message.find("fuzz") != std::string::npos,
          "an error that does not name its file");
  require(source.first_fault().empty() == (counters.malformed == 0), "the first fault is not kept");
  return 0;
}
