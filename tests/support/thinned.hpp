// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace terracut::test {

/// Under a sanitizer every third value is enough: what each leads to is shown by the build without,
/// and memory is touched in the same places for a few.
#ifdef TERRACUT_SANITIZED_BUILD
inline constexpr std::size_t kThinning = 3;
#else
inline constexpr std::size_t kThinning = 1;
#endif

/// The first of these and every kThinning-th after it.
template <class T>
std::vector<T> thinned(std::initializer_list<T> all) {
  std::vector<T> some;
  for (std::size_t i = 0; i < all.size(); i += kThinning) some.push_back(all.begin()[i]);
  return some;
}

}  // namespace terracut::test
