// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Must not compile with -Wfunction-effects: a marked function calls one that allocates.
#include <vector>

#include "rt/threads/nonblocking.hpp"

namespace terracut::threads {
namespace {

int grow(std::vector<int>& numbers) noexcept {
  numbers.push_back(1);
  return numbers.back();
}

}  // namespace

int blocking_call(std::vector<int>& numbers) noexcept TERRACUT_NONBLOCKING {
  return grow(numbers);
}

}  // namespace terracut::threads
