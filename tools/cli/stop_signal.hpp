// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "exit_codes.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// From now on Ctrl-C and SIGTERM only make stop_wanted() true and call `also`, if not null, which
/// has to suit a signal handler; a second one kills.
void catch_stop_signals(void (*also)() noexcept = nullptr);

[[nodiscard]] bool stop_wanted() noexcept;

// For work that is whole or not at all.
/// An error where stop_wanted(), to end the work with.
[[nodiscard]] Status go_on();
/// Prints why the work was not done, and returns the exit code: `error`, or that it was stopped.
[[nodiscard]] ExitCode refuse_work(const Error& error);

}  // namespace terracut::cli
