// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace terracut::doctor {

enum class Verdict : std::uint8_t {
  kOk,
  kWarning,  ///< May cause late or lost frames on a busy machine.
  kProblem,  ///< Will cause late or lost frames, or keeps them from coming in at all.
};

/// Returns "ok", "warning", "problem".
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

/// The result of one check.
struct Finding {
  std::string check;  ///< Its name in docs/guide/real_time.md: "kernel".
  Verdict verdict = Verdict::kOk;
  std::string found;
  std::string why{};   ///< Why it matters; empty if all is well.
  std::string mend{};  ///< The command that mends it, or the remedy; empty if all is well.
};

using Findings = std::vector<Finding>;

[[nodiscard]] inline Finding ok(std::string check, std::string found) {
  return {std::move(check), Verdict::kOk, std::move(found)};
}

}  // namespace terracut::doctor
