// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

namespace terracut::evaluation::report {

/// page_style.css, made part of the program by CMake.
extern const char* const kPageStyle;

}  // namespace terracut::evaluation::report
