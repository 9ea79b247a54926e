// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "rt/error.hpp"

namespace terracut::cli {

/// The program's exit status; printed by `terracut --help` and stable for scripts.
enum ExitCode : int {
  kOk = 0,
  kInternal = 1,         ///< A bug or a lack of memory; the input does not explain it.
  kUsage = 2,            ///< The command line is wrong: unknown option or value out of range.
  kInputRefused = 3,     ///< An input is missing, unreadable, malformed, or of a kind not handled.
  kOutputFailed = 4,     ///< An output could not be written whole; no file is left.
  kNothingCameOut = 5,   ///< Packets were read but no frame came out; the message names the check.
  kDeadlinesMissed = 6,  ///< A live run missed deadlines; all else was right.
  kNotReady = 7,         ///< `terracut doctor` found a problem of the machine.
  // 8 is used by ./tools/compare: a measure got worse.
  kInterrupted = 9,     ///< Ctrl-C or SIGTERM came before the work was done; reports say so.
  kMountNotFound = 10,  ///< The mount was neither stated nor found: no labels.
};

/// Returns the exit code for an error of the library.
[[nodiscard]] constexpr ExitCode exit_code_of(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::kNotFound:
    case ErrorCode::kUnreadable:
    case ErrorCode::kMalformed:
    case ErrorCode::kUnsupported:
    case ErrorCode::kNoCalibration:
      return kInputRefused;
    case ErrorCode::kMountNotFound:
      return kMountNotFound;
    case ErrorCode::kNothingCameOut:
      return kNothingCameOut;
    case ErrorCode::kInvalidArgument:
      return kUsage;
    case ErrorCode::kWriteFailed:
      return kOutputFailed;
    case ErrorCode::kCapacityExceeded:
      return kInternal;
  }
  return kInternal;
}

}  // namespace terracut::cli
