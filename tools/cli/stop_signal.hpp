// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "exit_codes.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// From now on Ctrl-C and SIGTERM only set stop_wanted() and call `also`, which may be null and
/// must be safe in a signal handler. A second signal kills the process.
void catch_stop_signals(void (*also)() noexcept = nullptr);

[[nodiscard]] bool stop_wanted() noexcept;

// Returns an error if stop_wanted(), for work that must be done either whole or not at all.
[[nodiscard]] Status go_on();
/// Prints why work was not done: `error`, or that it was stopped. Returns the exit code.
[[nodiscard]] ExitCode refuse_work(const Error& error);

}  // namespace terracut::cli
