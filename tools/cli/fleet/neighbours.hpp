// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "relabel_job.hpp"

namespace terracut::cli {

/// True if a process, here or on another host, seems to be labelling a drive; also true after one
/// was killed on another host, until somebody removes its part.
[[nodiscard]] bool seems_under_way(const RelabelJob& job, const FleetDrive& drive);

/// Waits until no process of this host labels a drive. Locks on parts tell, as the kernel releases
/// them however a process ends. Processes of other hosts cannot be known and are not waited for.
/// Returns early when stop_wanted().
void wait_for_neighbours(const RelabelJob& job, const FleetDrive& drive);

}  // namespace terracut::cli
