// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <initializer_list>
#include <ostream>
#include <random>

#include "firmware_io/can/can_frame.hpp"
#include "firmware_io/can/candump_line.hpp"

namespace terracut::can {

/// What GoogleTest shows of a frame.
inline void PrintTo(const CanFrame& frame, std::ostream* stream) {
  *stream << candump_line(frame, "can0");
}

}  // namespace terracut::can

namespace terracut::test {

inline can::CanFrame data_frame(can::CanId id, std::initializer_list<std::uint8_t> bytes,
                                std::int64_t stamp_ns = 0) {
  can::CanFrame frame;
  frame.id = id;
  frame.stamp_ns = stamp_ns;
  frame.length = static_cast<std::uint8_t>(bytes.size());
  frame.fd = bytes.size() > can::CanFrame::kMostClassicBytes;
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  return frame;
}

/// Any frame that can be on a bus.
inline can::CanFrame random_frame(std::mt19937& random) {
  using can::CanFrame;
  const auto below = [&](std::uint32_t count) {
    return std::uniform_int_distribution<std::uint32_t>(0, count - 1)(random);
  };
  CanFrame frame;
  frame.stamp_ns = static_cast<std::int64_t>(below(4'000'000'000)) * 1'000'000'000 +
                   below(1'000'000) * 1000 + (below(2) == 0 ? below(1000) : 0);
  const std::uint32_t kind = below(8);
  frame.error = kind == 0;
  frame.remote = kind == 1;
  frame.fd = kind >= 5;
  frame.id.extended = !frame.error && below(2) == 0;
  frame.id.number = frame.error || frame.id.extended ? below(0x20000000) : below(0x800);
  frame.length = static_cast<std::uint8_t>(below(9));
  if (frame.fd) {
    frame.bit_rate_switch = below(2) == 0;
    frame.sender_passive = below(2) == 0;
    do {
      frame.length = static_cast<std::uint8_t>(below(65));
    } while (!can::is_fd_length(frame.length));
  }
  if (!frame.remote) {
    std::generate_n(frame.data.begin(), frame.length,
                    [&] { return static_cast<std::uint8_t>(below(256)); });
  }
  return frame;
}

}  // namespace terracut::test
