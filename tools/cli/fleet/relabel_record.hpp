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

/// What became of a drive, as the process that tried last says.
struct RelabelRecord {
  std::string drive;
  bool done = false;
  std::string output{};   ///< Of one that is done: its folder below the job's.
  std::string cause{};    ///< Of one that is not: a few words, the same for failures of a kind,
  std::string message{};  ///< and all there is to say.
  std::string shard{}, host{};
  std::int64_t pid = 0, started_ns = 0, ended_ns = 0;  ///< Since 1970.
  ProgramRun run{};                                    ///< Zeros: its labels were there already.
  std::uint64_t frames = 0, returns = 0, label_bytes = 0;
  nlohmann::ordered_json losses = nlohmann::ordered_json::object();  ///< {cause: count}
  nlohmann::ordered_json stamps = nlohmann::ordered_json::object();  ///< stamps_of() its inputs.
  bool ends_shard = false;  ///< Not kept. It failed of what every other drive would fail of, too.
};

/// The newest one of a drive; an empty one where there is none, or where it is none of that drive
/// or says what no record can.
[[nodiscard]] RelabelRecord read_record(const std::filesystem::path& state,
                                        const std::string& drive);

/// Whole or not at all.
[[nodiscard]] Status write_record(const RelabelJob& job, const RelabelRecord& record);

}  // namespace terracut::cli
