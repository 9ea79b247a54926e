// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/decoder.hpp"
#include "firmware_io/ruby128/ruby128_sensor.hpp"

namespace terracut::firmware_io {

/// The decoder of RS-Ruby128 data packets (MSOP); used as Hdl64eDecoder is.
using Ruby128Decoder = Decoder<Ruby128Sensor>;

}  // namespace terracut::firmware_io
