// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "rt/monitor_snapshot.hpp"

namespace terracut::cli {

/// Figures that a process can have published: times and counts fit together, so that everything
/// that shows them may calculate with them. A status page is a file that others can write to, and
/// what is in it may be anything.
[[nodiscard]] bool are_possible(const rt::MonitorSnapshot& figures) noexcept;

}  // namespace terracut::cli
