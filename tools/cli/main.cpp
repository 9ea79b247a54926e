// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <array>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "tools/cli/arguments/arguments.hpp"
#include "tools/cli/input/command_files.hpp"

namespace terracut::cli {
namespace {

/// By Command.
constexpr std::array kRun{
    run_replay, run_view,      run_segment, run_manifest, run_relabel,    run_compare, run_simulate,
    run_encode, run_calibrate, run_info,    run_plan,     run_parameters, run_bench,   run_send,
    run_live,   run_node,      run_dump,    run_eval,     run_top,        run_config,  run_doctor};
static_assert(kRun.size() == kCommands.size());

ExitCode run(const std::vector<std::string>& words) {
  const auto arguments = parse_arguments(words);
  if (!arguments) {
    const ExitCode code = refuse(arguments.error());
    if (code == kUsage) say("`terracut --help` and `terracut COMMAND --help` say what is expected");
    return code;
  }
  if (!arguments->command) {
    fmt::print("{}", arguments->text);
    return kOk;
  }
  const auto claims = claim_outputs(files_of(*arguments));
  if (!claims) return refuse(claims.error());
  return kRun[static_cast<std::size_t>(*arguments->command)](arguments->options);
}

}  // namespace
}  // namespace terracut::cli

int main(int argc, char** argv) {
  using namespace terracut::cli;
  try {
    return run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const std::bad_alloc&) {
    return refuse(kInternal, "out of memory; `terracut plan` prints what is needed");
  } catch (const std::exception& error) {
    return refuse(kInternal, error.what());
  }
}
