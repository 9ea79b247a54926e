// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace terracut::doctor {

enum class Verdict : std::uint8_t {
  kOk,
  kWarning,  ///< Frames may be late or lost because of it, on a busy machine.
  kProblem,  ///< Frames will be late or lost because of it, or cannot come in at all.
};

/// "ok", "warning", "problem".
[[nodiscard]] constexpr const char* to_string(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kOk:
      return "ok";
    case Verdict::kWarning:
      return "warning";
    case Verdict::kProblem:
      break;
  }
  return "problem";
}

/// What one check says.
struct Finding {
  std::string check;  ///< Its name in docs/guide/real_time.md: "kernel".
  Verdict verdict = Verdict::kOk;
  std::string found;
  std::string why{};   ///< Why it matters; empty when all is well.
  std::string mend{};  ///< The command that mends it, or what to do; empty when all is well.
};

using Findings = std::vector<Finding>;

[[nodiscard]] inline Finding ok(std::string check, std::string found) {
  return {std::move(check), Verdict::kOk, std::move(found)};
}

}  // namespace terracut::doctor
