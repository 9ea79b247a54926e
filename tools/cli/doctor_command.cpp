// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include "commands.hpp"
#include "tools/doctor/checks.hpp"
#include "tools/doctor/report.hpp"

namespace terracut::cli {

ExitCode run(const DoctorOptions& options) {
  const doctor::Wishes wishes{.interface = options.interface,
                              .port = options.port,
                              .receive_core = options.receive_core,
                              .segment_core = options.segment_core};
  const doctor::Findings findings = examine(doctor::SystemView::of_this_machine(), wishes);
  fmt::print("{}", options.json ? json_of(findings) : text_of(findings));
  return count_of(findings, doctor::Verdict::kProblem) == 0 ? kOk : kNotReady;
}

}  // namespace terracut::cli
