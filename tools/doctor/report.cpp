// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace terracut::doctor {

int count_of(const Findings& findings, Verdict verdict) {
  return static_cast<int>(std::ranges::count(findings, verdict, &Finding::verdict));
}

std::string text_of(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text +=
        fmt::format("{:<8} {:<16} {}\n", to_string(finding.verdict), finding.check, finding.found);
    if (finding.verdict == Verdict::kOk) continue;
    text += fmt::format("{:>14}: {}\n{:>14}: {}\n", "why", finding.why, "mend", finding.mend);
  }
  const int problems = count_of(findings, Verdict::kProblem);
  const int warnings = count_of(findings, Verdict::kWarning);
  return text + fmt::format("{} problem{}, {} warning{} of {} checks\n", problems,
                            problems == 1 ? "" : "s", warnings, warnings == 1 ? "" : "s",
                            findings.size());
}

std::string json_of(const Findings& findings) {
  nlohmann::ordered_json json;
  json["problems"] = count_of(findings, Verdict::kProblem);
  json["warnings"] = count_of(findings, Verdict::kWarning);
  json["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    nlohmann::ordered_json one{{"check", finding.check},
                               {"verdict", to_string(finding.verdict)},
                               {"found", finding.found}};
    if (finding.verdict != Verdict::kOk) {
      one["why"] = finding.why;
      one["mend"] = finding.mend;
    }
    json["findings"].push_back(std::move(one));
  }
  // Names of devices and programs may not be UTF-8: invalid bytes are replaced.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terracut::doctor
