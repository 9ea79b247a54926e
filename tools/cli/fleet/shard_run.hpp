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

/// Labels the drives of a shard whose labels do not exist yet. Drives that other processes are
/// labelling come last; processes of this host are waited for. A drive that another host has not
/// finished by then is labelled again, because that host may be gone; if both finish, the second
/// drops its result. One thread.
class ShardRun {
 public:
  /// `shard` is a text such as "3/12", for records.
  ShardRun(const RelabelJob& job, std::string shard);

  /// Labels the drives and prints what was done. Returns kInterrupted; or kOutputFailed at the
  /// first output error that would also affect every other drive, such as a full disk; else the
  /// exit code of the last drive that failed, or kOk.
  [[nodiscard]] ExitCode run(const std::vector<FleetDrive>& drives);

 private:
  enum class Attention : unsigned char { kIfFree, kFinally };
  /// Handles one drive. Returns false if another process seems to be labelling it.
  bool attend(const FleetDrive& drive, Attention attention);
  /// True if the labels of `before` still exist and its inputs are those of `now`.
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
  bool ended_ = false;  ///< True if the last failure would stop the next drive, too.
};

}  // namespace terracut::cli
