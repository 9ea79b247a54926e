// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/ipv4_endpoint.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/doctor/checks.hpp"
#include "tools/doctor/report.hpp"

namespace terracut::cli {

ExitCode run_doctor(const Options& options) {
  const doctor::Requests requests{
      .interface = options.listen.interface,
      .port = net::parse_ipv4_endpoint(options.listen.address).value().port,
      .core = options.realtime.core};
  const doctor::Findings findings = examine(doctor::SystemView::of_this_machine(), requests);
  print_text(options.print_json ? json_of(findings) : text_of(findings));
  return count_of(findings, doctor::Verdict::kProblem) == 0 ? kOk : kNotReady;
}

}  // namespace terracut::cli
