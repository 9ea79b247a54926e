// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "firmware_io/packet/datagram.hpp"

namespace terracut::sensor {

/// What a datagram that sensor::recognise_sensor() does not know may be, for people: a packet that
/// is known with more bytes around it, or whose sensor sends to such a port or packets of such a
/// size. Empty: nobody known here does.
[[nodiscard]] std::string guess_of_unknown(const packet::Datagram& datagram);

}  // namespace terracut::sensor
