// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

/// Marks a function whose loops are worth compiling twice on x86-64: for the baseline and for AVX2;
/// the processor decides once, at program start. Both give the same results bit for bit: the same
/// IEEE operations, only more at once (no fused multiply-add, -ffp-contract=off). Left out for
/// sanitizers, which do not support the selection mechanism (ifunc), and for other processors,
/// which do not need it. clang 19 does not emit an inline function that only clones call, such as
/// the iterators of a range-for over a span: use indices in these functions.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(TERRACUT_SANITIZED_BUILD)
#define TERRACUT_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define TERRACUT_VECTOR_CLONES
#endif

/// Marks a function into which many inline functions are compiled. clang compiles it only once,
/// because it would not emit inline functions that only clones call.
#if defined(__clang__)
#define TERRACUT_VECTOR_CLONES_OF_INLINED
#else
#define TERRACUT_VECTOR_CLONES_OF_INLINED TERRACUT_VECTOR_CLONES
#endif
