// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

/// Marks a function that real-time threads call: it neither allocates nor locks nor waits, and
/// calls only functions of which the same is true. It belongs behind `noexcept`:
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
#ifndef TERRACUT_NONBLOCKING
#define TERRACUT_NONBLOCKING
#endif
