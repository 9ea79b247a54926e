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

/// What became of a dump that somebody asked a running process for.
struct DumpAnswer {
  int pid = 0;
  std::uint64_t serial = 0;  ///< 1.. for the process's first answer and so on.
  std::string capture;       ///< The file that was written; empty when it was refused.
  std::string calibration;   ///< The unit's table beside it, if it was written, too.
  std::uint64_t datagrams = 0;
  double seconds = 0;   ///< From its first datagram to its last.
  std::string refusal;  ///< DumpRefusal's name.
  std::string message;  ///< Why it was refused.
};

/// The running process's side: its last answer lies beside its status page as
/// `NAME.terracut-dump`, for `terracut dump` to read. One thread; not real-time.
class DumpAnswers {
 public:
  DumpAnswers(const std::filesystem::path& folder, const std::string& name);
  DumpAnswers(const DumpAnswers&) = delete;
  DumpAnswers& operator=(const DumpAnswers&) = delete;
  ~DumpAnswers();  ///< Takes the answer away.

  /// kWriteFailed; the dump itself stands, only who asked does not hear of it.
  [[nodiscard]] Status publish(
      const tl::expected<recorder::DumpReport, recorder::RefusedDump>& outcome);

 private:
  std::filesystem::path path_;
  std::uint64_t serial_ = 0;
};

/// The last answer of the process of this name, alive or not; nothing when there is none, or one
/// that anybody could have written (rt/files/trusted_file.hpp). Its texts may hold any bytes.
[[nodiscard]] std::optional<DumpAnswer> read_dump_answer(const std::filesystem::path& folder,
                                                         const std::string& name);

}  // namespace terracut::cli
