// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <fmt/format.h>

#include <string_view>

#include "rt/error.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {

/// Prints that an output or server (`what`) has become unavailable or available again
/// (publish::Reopened).
inline void tell_of_door(std::string_view what, const Status& now) {
  if (now) return say(fmt::format("{} again", what));
  warn(fmt::format("no {}, which is tried again every 10 s: {}", what, now.error().message));
}

}  // namespace terracut::cli
