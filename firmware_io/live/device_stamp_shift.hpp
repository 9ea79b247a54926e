// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

namespace terracut::firmware_io {

/// Adds `shift_ns`, rounded to the device's unit, to the device stamp of a data packet, as if the
/// sensor's clock had jumped; the hour of an HDL-64E wraps. False, and the packet untouched, for
/// payloads that are no data packet of a sensor whose stamp is known.
[[nodiscard]] bool shift_device_stamp(std::span<std::uint8_t> payload,
                                      std::int64_t shift_ns) noexcept;

}  // namespace terracut::firmware_io
