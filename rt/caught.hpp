// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <exception>
#include <new>

#include "rt/error.hpp"

namespace terracut::rt {

/// Returns the Status of `work()`. An exception becomes the error kCapacityExceeded, for a thread
/// that has to go on when the system refuses memory for one piece of work.
template <class Work>
[[nodiscard]] Status caught(const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kCapacityExceeded, "out of memory");
  } catch (const std::exception& error) {
    return fail(ErrorCode::kCapacityExceeded, error.what());
  }
}

}  // namespace terracut::rt
