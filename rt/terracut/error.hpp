// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace terracut {

/// The kinds of error that a program may need to tell apart. The message tells a person the
/// details.
enum class ErrorCode {
  kNotFound,    ///< A named file, folder or stream does not exist.
  kUnreadable,  ///< The file or folder exists, but the system refused to read it.
  kMalformed,   ///< The input was read, but is not what it claims to be.
  /// The input is well formed, but of a kind that terracut does not handle (such as another model).
  kUnsupported,
  kInvalidArgument,   ///< A setting or option lies outside its documented range.
  kCapacityExceeded,  ///< More memory is needed than was planned at start, or than the system has.
  kWriteFailed,       ///< The output could not be written whole; nothing was left in its place.
  kNoCalibration,     ///< Neither a calibration file nor a calibration in the packets was found.
  kMountNotFound,     ///< The sensor's mount was neither stated nor seen well enough for labels.
  kNothingCameOut,    ///< The input was read to its end, but none of it passed the checks.
};

[[nodiscard]] std::string_view to_string(ErrorCode code) noexcept;

/// An error of start-up or file work (never of the per-packet path, which counts instead).
struct Error {
  ErrorCode code;
  std::string message;  ///< Says what was expected, what was found, where, and what to do about it.
};

template <class T>
using Expected = tl::expected<T, Error>;
using Status = Expected<void>;

/// Makes an error: a shorthand for `return fail(ErrorCode::kMalformed, "...")`.
[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message)});
}

}  // namespace terracut
