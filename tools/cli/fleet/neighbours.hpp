// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "relabel_job.hpp"

namespace terracut::cli {

/// Whether some process, here or on another host, seems to be at a drive. One that was killed on
/// another host seems so, too, until somebody takes its part away.
[[nodiscard]] bool seems_under_way(const RelabelJob& job, const FleetDrive& drive);

/// Waits until no process of this host is at a drive, by the locks on their parts, which the kernel
/// takes away however they end. What other hosts do cannot be known: it is not waited for. Returns
/// early when stop_wanted().
void wait_for_neighbours(const RelabelJob& job, const FleetDrive& drive);

}  // namespace terracut::cli
