// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace terracut::capture {

/// What a file that is no capture looks like by its first bytes, for error messages: their hex
/// values and, where known, a name and what to do ("1f 8b 08 00: gzip; unpack it first").
[[nodiscard]] std::string describe_first_bytes(std::span<const std::uint8_t> first_bytes);

}  // namespace terracut::capture
