// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <vector>

namespace terracut::dds {

/// Makes a sequence of C structures in the memory of a vector.
template <class Sequence, class Element>
[[nodiscard]] Sequence sequence_of(std::vector<Element>& elements) {
  const auto length = static_cast<std::uint32_t>(elements.size());
  return {length, length, elements.data(), false};
}

}  // namespace terracut::dds
