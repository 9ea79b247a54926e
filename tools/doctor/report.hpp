// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "finding.hpp"

namespace terracut::doctor {

/// How many findings have that verdict.
[[nodiscard]] int count_of(const Findings& findings, Verdict verdict);

/// For people: a line a finding, with why and what mends it below those that are not ok.
[[nodiscard]] std::string text_of(const Findings& findings);

/// For programs: {"problems", "warnings", "findings": [{"check", "verdict", "found", "why",
/// "mend"}]}; `why` and `mend` only where something is amiss.
[[nodiscard]] std::string json_of(const Findings& findings);

}  // namespace terracut::doctor
