// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json.hpp>

#include "relabel_job.hpp"
#include "relabel_record.hpp"
#include "tools/cli/exit_codes.hpp"

namespace terracut::cli {

/// Labels a drive in a folder of its own below the job's parts, by `terracut replay` or `segment`,
/// and puts what came out in its place, "job.folder/record.output". Completes `record`: done, or
/// the cause of the failure. Whatever happens, nothing half written gets that name, nor what came
/// of inputs that are no longer those of `record.stamps`, which were taken before they were hashed.
/// Returns what the failure would be as an exit code; kInterrupted leaves the record as it is.
[[nodiscard]] ExitCode label_drive(const RelabelJob& job, const FleetDrive& drive,
                                   const nlohmann::ordered_json& recipe, RelabelRecord& record);

/// What the facts of a whole folder (labelled_drive.hpp) say for the record of its drive.
void take_facts(const nlohmann::ordered_json& facts, RelabelRecord& record);

/// The cause and exit code of an error before the labelling, as of an input that is not there.
[[nodiscard]] ExitCode note_failure(const Error& error, RelabelRecord& record);

}  // namespace terracut::cli
