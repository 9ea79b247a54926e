// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/hdl64e/hdl64e_sensor.hpp"

namespace terracut::hdl64e {

/// The decoder of HDL-64E S2, S2.1 and S3 data packets:
///
///   memory::FixedMemory memory;
///   Hdl64eDecoder decoder(calibration, mount, {}, memory);
///   auto on_frame = [&](const FrameInfo&, const frame::RangeImage&) noexcept { ... };
///   while (auto datagram = ...next datagram...) decoder.decode(*datagram, on_frame);
///   decoder.flush(on_frame);
using Hdl64eDecoder = decode::Decoder<Hdl64eSensor>;

}  // namespace terracut::hdl64e
