// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "relabel_job.hpp"
#include "relabel_record.hpp"
#include "tools/cli/exit_codes.hpp"

namespace terracut::cli {

/// A process's way through its shard: each drive is labelled unless its labels are there. Drives
/// that others are at come last, and those of this host are waited for; what other hosts have not
/// finished by then is done once more, for they may be gone: whoever comes second throws its own
/// away. One thread.
class ShardRun {
 public:
  /// `shard`: "3/12", for records.
  ShardRun(const RelabelJob& job, std::string shard);

  /// Prints what was done. kInterrupted; kOutputFailed at the first output that cannot be written
  /// of a cause that every other would meet, too, as a full disk; else the exit code of the last
  /// drive that failed, or kOk.
  [[nodiscard]] ExitCode run(const std::vector<FleetDrive>& drives);

 private:
  enum class Attention : unsigned char { kIfFree, kFinally };
  /// False: somebody else seems to be at it.
  bool attend(const FleetDrive& drive, Attention attention);
  /// An earlier record is of the same inputs, and what it speaks of still stands.
  [[nodiscard]] bool is_there(const RelabelRecord& before, const RelabelRecord& now) const;
  void label(const FleetDrive& drive, RelabelRecord record);
  void failed(const RelabelRecord& record, ExitCode code);
  void note(const RelabelRecord& record);
  [[nodiscard]] ExitCode conclude() const;

  const RelabelJob& job_;
  std::string shard_;
  std::int64_t started_ns_;
  std::uint64_t labelled_ = 0, there_ = 0, failed_ = 0, frames_ = 0;
  std::map<std::string, std::vector<std::string>> failures_;  ///< Drives by cause.
  ExitCode worst_ = kOk;
  bool ended_ = false;  ///< What stands in the way stands in that of the next drive, too.
};

}  // namespace terracut::cli
