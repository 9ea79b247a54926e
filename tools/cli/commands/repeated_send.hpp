// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>

#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Sends the capture repeatedly in real time, as run_send() does but without faults and summary,
/// until `enough` or stop_wanted(). Fails if the capture or a socket cannot be opened.
[[nodiscard]] Status send_until(const Options& options, const std::atomic<bool>& enough);

}  // namespace terracut::cli
