// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

namespace terracut::cli {

/// From now on Ctrl-C and SIGTERM only make stop_wanted() true; a second one kills.
void catch_stop_signals();

[[nodiscard]] bool stop_wanted() noexcept;

}  // namespace terracut::cli
