// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/ruby128/ruby128_sensor.hpp"

namespace terracut::ruby128 {

/// The decoder of RS-Ruby128 data packets (MSOP); used as Hdl64eDecoder is.
using Ruby128Decoder = decode::Decoder<Ruby128Sensor>;

}  // namespace terracut::ruby128
