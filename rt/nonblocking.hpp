// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

/// TERRACUT_NONBLOCKING marks a function that real-time threads call: it neither allocates nor
/// locks nor waits, and calls only functions of which the same is true. It belongs behind
/// `noexcept`:
///
///     void record(std::int64_t value_ns) noexcept TERRACUT_NONBLOCKING;
///
/// Clang 20 and later check it while compiling (-Wfunction-effects) and, with -fsanitize=realtime,
/// while running; for other compilers it is a remark to the reader.
#if defined(__clang__) && defined(__has_cpp_attribute)
#if __has_cpp_attribute(clang::nonblocking)
#define TERRACUT_NONBLOCKING [[clang::nonblocking]]
#endif
#endif

/// Between these two lines calls are not checked while compiling: for system calls that are known
/// not to wait, but that no header marks. Each use says why it may be trusted.
#ifdef TERRACUT_NONBLOCKING
#define TERRACUT_TRUSTED_CALLS_BEGIN \
  _Pragma("clang diagnostic push") _Pragma("clang diagnostic ignored \"-Wfunction-effects\"")
#define TERRACUT_TRUSTED_CALLS_END _Pragma("clang diagnostic pop")
#else
#define TERRACUT_NONBLOCKING
#define TERRACUT_TRUSTED_CALLS_BEGIN
#define TERRACUT_TRUSTED_CALLS_END
#endif

#if defined(__clang__) && defined(__has_feature)
#if __has_feature(realtime_sanitizer)
#define TERRACUT_REALTIME_SANITIZER
#include <sanitizer/rtsan_interface.h>
#endif
#endif

namespace terracut::rt {

/// The same for checks while running: as long as this lives, the real-time sanitizer lets the
/// calling thread's system calls pass.
#ifdef TERRACUT_REALTIME_SANITIZER
using TrustedCalls = __rtsan::ScopedDisabler;
#else
struct TrustedCalls {
  TrustedCalls() noexcept {}  // not trivial, or each use would be an unused variable
};
#endif

}  // namespace terracut::rt
