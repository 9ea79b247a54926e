// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/error.hpp"

namespace terracut {

std::string_view to_string(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::kNotFound:
      return "not found";
    case ErrorCode::kUnreadable:
      return "unreadable";
    case ErrorCode::kMalformed:
      return "malformed";
    case ErrorCode::kUnsupported:
      return "unsupported";
    case ErrorCode::kInvalidArgument:
      return "invalid argument";
    case ErrorCode::kCapacityExceeded:
      return "capacity exceeded";
    case ErrorCode::kWriteFailed:
      return "write failed";
    case ErrorCode::kNoCalibration:
      return "no calibration";
    case ErrorCode::kMountNotFound:
      return "mount not found";
    case ErrorCode::kNothingCameOut:
      return "nothing came out";
  }
  return "unknown";
}

}  // namespace terracut
