// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/streams/hear_sensor.hpp"

#include <chrono>
#include <cstdint>

namespace terracut::streams {

Expected<SensorOnAir> hear_sensor(FirstSeconds& first, net::LiveSource& data,
                                  net::LiveSource* device, const Waiting& waiting) {
  using Clock = std::chrono::steady_clock;
  const auto hear = [&](net::LiveSource& from, std::int64_t timeout_ns) {
    for (const packet::Datagram& datagram : from.receive(timeout_ns)) first.add(datagram);
  };
  const auto begun = Clock::now();
  const auto is_over = [&] {
    return waiting.patience_s &&
           Clock::now() - begun >= std::chrono::duration<double>(*waiting.patience_s);
  };
  while (!first.is_enough() && !is_over() && !waiting.stop_wanted()) {
    constexpr std::int64_t kAWhile_ns = 50'000'000;
    hear(data, kAWhile_ns);
    if (device != nullptr) hear(*device, 0);
    first.note_foreign(data.counters().foreign);
    if (waiting.on_waiting) waiting.on_waiting(first.waits_for());
  }
  return first.conclude(waiting.patience_s);
}

}  // namespace terracut::streams
