// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "program_run.hpp"
#include "relabel_job.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// The state of a drive as recorded by the last process that tried to label it.
struct RelabelRecord {
  std::string drive;
  bool done = false;
  std::string output{};   ///< If done: the drive's folder below the job's folder.
  std::string cause{};    ///< If failed: a few words, equal for similar failures.
  std::string message{};  ///< If failed: the full message.
  std::string shard{}, host{};
  std::int64_t pid = 0, started_ns = 0, ended_ns = 0;  ///< Since 1970.
  ProgramRun run{};                                    ///< All zero if the labels existed already.
  std::uint64_t frames = 0, returns = 0, label_bytes = 0;
  nlohmann::ordered_json losses = nlohmann::ordered_json::object();  ///< {cause: count}
  nlohmann::ordered_json stamps = nlohmann::ordered_json::object();  ///< stamps_of() of inputs.
  bool ends_shard = false;  ///< Not stored; the failure would affect every other drive, too.
};

/// Returns a drive's newest record. Returns an empty record if there is none, it belongs to another
/// drive, or it has impossible values.
[[nodiscard]] RelabelRecord read_record(const std::filesystem::path& state,
                                        const std::string& drive);

/// Writes a record, whole or not at all.
[[nodiscard]] Status write_record(const RelabelJob& job, const RelabelRecord& record);

}  // namespace terracut::cli
