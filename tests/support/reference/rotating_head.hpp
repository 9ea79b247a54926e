// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/mount/mount.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"

namespace terracut::reference {

/// A head that rotates steadily clockwise and measures noise.
struct RotatingHead {
  double spin_hz = 10;
  bool dual_return = false;
  double first_deg = 340;
  int packets = 2'000;
  double share_of_returns = 0.8;
  unsigned seed = 1;
};

/// How an RS-Ruby128 writes its time (byte 10 on).
enum class RubyClock : std::uint8_t { kCalendar, kMicroseconds, kNanoseconds };

struct Payload {
  std::vector<std::uint8_t> bytes;
  std::int64_t stamp_ns = 0;
};

/// Data packets, byte by byte as the formats describe them.
[[nodiscard]] std::vector<Payload> hdl64e_payloads(const RotatingHead& head);
[[nodiscard]] std::vector<Payload> ruby128_payloads(const RotatingHead& head,
                                                    RubyClock clock = RubyClock::kMicroseconds);

/// Where the head stood at a column of a payload.
void set_hdl64e_azimuth(std::vector<std::uint8_t>& payload, int column, unsigned cdeg);
void set_ruby128_azimuth(std::vector<std::uint8_t>& payload, int column, unsigned cdeg);

/// One return; a raw distance of 0 is none.
void set_hdl64e_return(std::vector<std::uint8_t>& payload, int column, int laser, unsigned raw,
                       unsigned intensity);
void set_ruby128_return(std::vector<std::uint8_t>& payload, int column, int laser, unsigned raw,
                        unsigned intensity);

/// The device's clock, of the HDL-64E at the packet's end and of the RS-Ruby128 at its first
/// firing. The calendar is for the first day of 2026.
void set_hdl64e_clock(std::vector<std::uint8_t>& payload, std::int64_t time_ns);
void set_ruby128_clock(std::vector<std::uint8_t>& payload, std::int64_t time_ns, RubyClock clock);

/// Any unit within the spans of real ones, and any mount.
[[nodiscard]] hdl64e::Hdl64eCalibration random_hdl64e(std::mt19937& random);
[[nodiscard]] ruby128::Ruby128Calibration random_ruby128(std::mt19937& random);
[[nodiscard]] mount::Mount random_mount(std::mt19937& random);

}  // namespace terracut::reference
