// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "rt/threads/nonblocking.hpp"

namespace terracut::frame {

/// Transposes by blocks of eight: `to` has `columns` rows of `rows` values. Both are multiples of
/// 8.
void transpose(const std::uint16_t* from, std::size_t rows, std::size_t columns,
               std::uint16_t* to) noexcept TERRACUT_NONBLOCKING;
void transpose(const std::uint8_t* from, std::size_t rows, std::size_t columns,
               std::uint8_t* to) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::frame
