// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "pipeline/recorder/dump_record.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// The outcome of a dump requested from a running process.
struct DumpAnswer {
  int pid = 0;
  std::uint64_t serial = 0;  ///< Sequence number of the process's answer, from 1.
  std::string capture;       ///< The file written; empty if the dump was refused.
  std::string calibration;   ///< The unit's table beside the file, if written.
  std::uint64_t datagrams = 0;
  double seconds = 0;   ///< Time from the first to the last datagram of the file.
  std::string refusal;  ///< Name of the DumpRefusal.
  std::string message;  ///< Why the dump was refused.
};

/// Publishes a process's last answer beside its status page as `NAME.terracut-dump`, for `terracut
/// dump` to read. One thread; not real-time.
class DumpAnswers {
 public:
  DumpAnswers(const std::filesystem::path& folder, const std::string& name);
  DumpAnswers(const DumpAnswers&) = delete;
  DumpAnswers& operator=(const DumpAnswers&) = delete;
  ~DumpAnswers();  ///< Removes the answer.

  /// Publishes an answer. Fails with kWriteFailed; the dump is kept, but nobody gets the answer.
  [[nodiscard]] Status publish(
      const tl::expected<recorder::DumpReport, recorder::RefusedDump>& outcome);

 private:
  std::filesystem::path path_;
  std::uint64_t serial_ = 0;
};

/// Returns the last answer of the process of this name, alive or not; nothing if there is none or
/// anybody could have written it (rt/files/trusted_file.hpp). Its texts may have any bytes.
[[nodiscard]] std::optional<DumpAnswer> read_dump_answer(const std::filesystem::path& folder,
                                                         const std::string& name);

}  // namespace terracut::cli
