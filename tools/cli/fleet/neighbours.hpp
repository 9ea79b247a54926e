// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "relabel_job.hpp"

namespace terracut::cli {

/// True if a process, here or on another host, seems to be labelling a drive. It also stays true
/// after such a process was killed on another host, until somebody removes its part.
[[nodiscard]] bool seems_under_way(const RelabelJob& job, const FleetDrive& drive);

/// Waits until no process of this host labels a drive: each holds a lock on its part, which the
/// kernel releases however it ends. Processes of other hosts cannot be seen and are not waited for.
/// Returns early when stop_wanted().
void wait_for_neighbours(const RelabelJob& job, const FleetDrive& drive);

}  // namespace terracut::cli
