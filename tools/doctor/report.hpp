// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "finding.hpp"

namespace terracut::doctor {

/// Returns the number of findings with that verdict.
[[nodiscard]] int count_of(const Findings& findings, Verdict verdict);

/// Returns the report for people: a line per finding; findings that are not ok also have the reason
/// and the remedy.
[[nodiscard]] std::string text_of(const Findings& findings);

/// Returns the report for programs: {"problems", "warnings", "findings": [{"check", "verdict",
/// "found", "why", "mend"}]}; `why` and `mend` only if not ok.
[[nodiscard]] std::string json_of(const Findings& findings);

}  // namespace terracut::doctor
