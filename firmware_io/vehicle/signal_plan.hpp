// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "firmware_io/can/can_frame.hpp"
#include "firmware_io/vehicle/dbc_file.hpp"
#include "rt/error.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::vehicle {

/// Extracts one signal from a frame: loads up to nine bytes, shifts, masks and scales. Made once
/// from a DBC file; a plain value.
class SignalPlan {
 public:
  /// Makes the plan of a signal, named as for find_signal(). Fails with kInvalidArgument if there
  /// is none, or several; kUnsupported if the signal is only in some frames of its message
  /// (multiplexed); kMalformed, with the line, if it does not fit into its message, has no bits or
  /// more than 64, or the message's id fits no format.
  [[nodiscard]] static Expected<SignalPlan> make(const DbcFile& file, std::string_view name);

  [[nodiscard]] const can::CanId& id() const noexcept { return id_; }

  /// Returns the signal's value in the unit of its file; nothing if the frame is too short for it.
  /// A floating-point signal may be infinite or NaN. `frame` must be a data frame of id().
  [[nodiscard]] std::optional<double> value(const can::CanFrame& frame) const noexcept
      TERRACUT_NONBLOCKING;

 private:
  can::CanId id_;
  std::uint8_t first_byte_ = 0;
  std::uint8_t byte_count_ = 0;  ///< [1, 9]
  std::uint8_t shift_ = 0;       ///< Bits below the signal in its last (Motorola) or first byte.
  std::uint8_t bit_count_ = 0;   ///< [1, 64]
  bool motorola_ = false;
  DbcNumber number_ = DbcNumber::kUnsigned;
  double factor_ = 1, offset_ = 0;
};

}  // namespace terracut::vehicle
