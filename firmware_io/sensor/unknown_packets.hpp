// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>

#include "firmware_io/packet/datagram.hpp"

namespace terracut::sensor {

/// What to do with a sensor whose packets are not read.
inline constexpr std::string_view kWhatInstead =
    "Clouds that its own driver makes of them are labelled by `terracut segment` (files) and "
    "`terracut node` (ROS 2)";

/// Guesses, for people, what a datagram is that sensor::recognise_sensor() does not know: a known
/// packet with more bytes around it, one with the header of a maker that is known, with the models
/// that are nearest of those that are read, or a packet of a sensor that uses this port or size.
/// Empty if there is no guess.
[[nodiscard]] std::string guess_of_unknown(const packet::Datagram& datagram);

}  // namespace terracut::sensor
