// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json.hpp>

#include "relabel_job.hpp"
#include "relabel_record.hpp"
#include "tools/cli/exit_codes.hpp"

namespace terracut::cli {

/// Labels a drive in a folder of its own among the job's parts, by `terracut replay` or `segment`,
/// and moves the result to its place, "job.folder/record.output". Completes `record`: done, or the
/// cause of the failure. That place never gets anything incomplete, nor a result whose inputs have
/// changed since `record.stamps`, which were taken before the inputs were hashed. Returns the
/// failure's exit code; kInterrupted leaves the record unchanged.
[[nodiscard]] ExitCode label_drive(const RelabelJob& job, const FleetDrive& drive,
                                   const nlohmann::ordered_json& recipe, RelabelRecord& record);

/// Copies the facts of a complete folder (labelled_drive.hpp) into the record of its drive.
void take_facts(const nlohmann::ordered_json& facts, RelabelRecord& record);

/// Records an error that came before labelling, such as a missing input. Returns its exit code.
[[nodiscard]] ExitCode note_failure(const Error& error, RelabelRecord& record);

}  // namespace terracut::cli
