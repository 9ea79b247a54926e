// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

/// Marks a function whose loops are worth compiling twice on x86-64: for the baseline and for AVX2,
/// chosen once at program start by the processor. The results are the same bit for bit: the same
/// IEEE operations, only more of them at once (no fused multiply-add, -ffp-contract=off).
/// Sanitizers do not support the selection mechanism (ifunc); other processors do not need it.
/// clang 19 does not emit an inline function that only clones call, such as the iterators of a
/// range-for over a span: use indices there.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(TERRACUT_SANITIZED_BUILD)
#define TERRACUT_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define TERRACUT_VECTOR_CLONES
#endif

/// Marks a function into which many inline functions are compiled. clang compiles it only once, for
/// the reason above.
#if defined(__clang__)
#define TERRACUT_VECTOR_CLONES_OF_INLINED
#else
#define TERRACUT_VECTOR_CLONES_OF_INLINED TERRACUT_VECTOR_CLONES
#endif
