// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "rt/threads/nonblocking.hpp"

namespace terracut::frame {

/// Transposes a matrix in blocks of eight by eight: `to` gets `columns` rows of `rows` values. Both
/// counts are multiples of 8.
void transpose(const std::uint16_t* from, std::size_t rows, std::size_t columns,
               std::uint16_t* to) noexcept TERRACUT_NONBLOCKING;
void transpose(const std::uint8_t* from, std::size_t rows, std::size_t columns,
               std::uint8_t* to) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::frame
