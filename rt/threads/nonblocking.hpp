// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

/// TERRACUT_NONBLOCKING marks a function that real-time threads call: it neither allocates nor
/// locks nor waits, and calls only functions with the same properties. The mark stands after
/// `noexcept`:
///
///     void record(std::int64_t value_ns) noexcept TERRACUT_NONBLOCKING;
///
/// Clang 22 and later check the mark while compiling (-Wfunction-effects), 20 and later while
/// running (-fsanitize=realtime); other compilers ignore it.
///
/// Marking the declaration is enough. A function whose body the compiler sees needs no mark: the
/// compiler infers it. So a template that calls a function passed to it is checked together with
/// that function.
#if defined(__clang__) && __clang_major__ >= 20
#define TERRACUT_NONBLOCKING [[clang::nonblocking]]
#else
#define TERRACUT_NONBLOCKING
#endif

#if defined(__clang__) && defined(__has_feature)
#if __has_feature(realtime_sanitizer)
#define TERRACUT_REALTIME_SANITIZER
#include <sanitizer/rtsan_interface.h>
#endif
#endif

namespace terracut::threads {

/// Calls `function` unchecked, at compile time and at run time: for system calls that are known not
/// to wait but that no header marks, and where a thread waits for its work. Each use says why it
/// may be trusted, and covers only the calls in question.
template <class Function>
decltype(auto) trusted_call(Function&& function) noexcept TERRACUT_NONBLOCKING {
#ifdef __clang__
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wunknown-warning-option"
#pragma clang diagnostic ignored "-Wfunction-effects"
#endif
#ifdef TERRACUT_REALTIME_SANITIZER
  const __rtsan::ScopedDisabler unchecked;
#endif
  return function();
#ifdef __clang__
#pragma clang diagnostic pop
#endif
}

}  // namespace terracut::threads
