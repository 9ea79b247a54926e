// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "calib/ruby128/ruby128_calibration.hpp"
#include "reference_return.hpp"

namespace terracut::reference {

/// A plain, slow decoder of RS-Ruby128 data packets (MSOP), single and dual return, written from
/// the layout, firing times and geometry of the maker's manual and driver, byte by byte and in
/// double. It shares nothing with the product's decoder but the calibration's struct, so that a
/// mistake would have to be made twice.
///
/// What no manual says is as terracut fixes it: the step from firing to firing is the packet's own
/// - half of what three single columns advance, in dual return the one advance inside the packet -
/// but both returns of one firing have one step, that of the packet which brought the first.
class Ruby128Reference {
 public:
  explicit Ruby128Reference(const ruby128::Ruby128Calibration& calibration)
      : calibration_(calibration) {}

  /// `column` of a return is its block. Packets in order; call reset() where some are missing.
  [[nodiscard]] Packet decode(std::span<const std::uint8_t> payload);

  /// The next packet does not follow the last one.
  void reset() { pending_step_deg_.reset(); }

 private:
  void locate(Return& beam) const;

  ruby128::Ruby128Calibration calibration_;
  int pending_cdeg_ = 0;                    ///< A firing whose second return is yet to come.
  std::optional<double> pending_step_deg_;  ///< Its step.
};

/// Degrees Celsius in a data packet of 1248 bytes.
[[nodiscard]] double ruby128_temperature_c(std::span<const std::uint8_t> payload);

/// The device's time in a data packet of 1248 bytes, nanoseconds since 1970 (UTC), by each of the
/// encodings in the field; nothing when the bytes are no time in that encoding.
[[nodiscard]] std::optional<std::int64_t> ruby128_calendar_ns(
    std::span<const std::uint8_t> payload);
[[nodiscard]] std::optional<std::int64_t> ruby128_microseconds_ns(
    std::span<const std::uint8_t> payload);
[[nodiscard]] std::optional<std::int64_t> ruby128_nanoseconds_ns(
    std::span<const std::uint8_t> payload);

}  // namespace terracut::reference
