// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "firmware_io/packet/datagram.hpp"

namespace terracut::sensor {

/// Guesses, for people, what a datagram is that sensor::recognise_sensor() does not know: a known
/// packet with more bytes around it, or a packet of a sensor that uses this port or size. Empty if
/// there is no guess.
[[nodiscard]] std::string guess_of_unknown(const packet::Datagram& datagram);

}  // namespace terracut::sensor
