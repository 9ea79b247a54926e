// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Any bytes as a DBC file: an error that names it, or signals each of which is refused or gives the
// value that going bit by bit gives, of a frame whose data are the file's last bytes.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "firmware_io/vehicle/signal_plan.hpp"
#include "input.hpp"
#include "tests/firmware_io/vehicle/slow_signal.hpp"

namespace {

using namespace terracut;
using terracut::fuzz::require;

void compare(const vehicle::SignalPlan& plan, const vehicle::DbcSignal& signal,
             can::CanFrame frame) {
  frame.id = plan.id();
  const auto value = plan.value(frame);
  require(value.has_value(), "a signal that fits its message has no value");
  const bool whole = signal.number == vehicle::DbcNumber::kUnsigned ||
                     signal.number == vehicle::DbcNumber::kSigned;
  if (!whole) return;
  const double slow = terracut::test::slow_value(signal, frame.payload());
  require(*value == slow || (std::isnan(*value) && std::isnan(slow)), "two values of one signal");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = vehicle::parse_dbc(std::string(data, data + size), "fuzz");
  if (!file) {
    require(file.error().message.find("fuzz") != std::string::npos, "an error without its file");
    return 0;
  }
  can::CanFrame frame;
  frame.fd = true;
  frame.length = can::CanFrame::kMostBytes;
  const std::size_t tail = std::min(size, frame.data.size());
  std::copy_n(data + size - tail, tail, frame.data.begin());
  std::size_t left = 50;  // finding a signal by name takes as long as the file is
  for (const vehicle::DbcMessage& message : file->messages) {
    for (const vehicle::DbcSignal& signal : message.signals) {
      if (left-- == 0) return 0;
      const std::string name = message.name + "." + signal.name;
      const auto found = vehicle::find_signal(*file, name);
      const auto plan = vehicle::SignalPlan::make(*file, name);
      if (!plan) {
        require(plan.error().message.find("fuzz") != std::string::npos,
                "an error without its file");
        continue;
      }
      require(found && found->signal == &signal, "a plan of another signal");
      require(plan->id().valid(), "a plan of no message");
      compare(*plan, signal, frame);
    }
  }
  return 0;
}
