// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "tools/cli/arguments/arguments.hpp"
#include "tools/cli/arguments/command_files.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

/// Indexed by Command.
constexpr std::array kRun{run_replay,  run_view,       run_segment,   run_manifest,  run_relabel,
                          run_compare, run_simulate,   run_encode,    run_calibrate, run_info,
                          run_plan,    run_parameters, run_detection, run_bench,     run_send,
                          run_live,    run_node,       run_dump,      run_eval,      run_top,
                          run_config,  run_doctor};
static_assert(kRun.size() == kCommands.size());

/// Opens those of the standard descriptors that are closed: otherwise the next opened file would
/// get such a number, and messages would be written into it.
void hold_standard_descriptors() {
  int opened = ::open("/dev/null", O_RDWR);
  while (opened >= 0 && opened <= STDERR_FILENO) opened = ::dup(opened);
  if (opened >= 0) ::close(opened);
}

ExitCode run_command(const std::vector<std::string>& words) {
  auto arguments = parse_arguments(words);
  if (!arguments) {
    const ExitCode code = refuse(arguments.error());
    if (code == kUsage) say("`terracut --help` and `terracut COMMAND --help` say what is expected");
    return code;
  }
  if (!arguments->command) {
    print_text(arguments->text);
    return kOk;
  }
  std::vector<Error> unwritable;  // outputs without which a live run goes on
  const bool goes_on = arguments->command == Command::kLive;
  const RunFiles files = files_of(*arguments);
  const auto claims = claim_outputs(files, goes_on ? &unwritable : nullptr);
  if (!claims) return refuse(claims.error());
  for (const Error& each : unwritable) warn(each.message);
  if (const std::string replaced = replaced_by(files); !replaced.empty()) say(replaced);
  arguments->options.output.made_of = files.made_of;
  return kRun[static_cast<std::size_t>(*arguments->command)](arguments->options);
}

ExitCode run(const std::vector<std::string>& words) {
  try {
    return run_command(words);
  } catch (const std::bad_alloc&) {
    return refuse(kInternal, "out of memory; `terracut plan` prints what is needed");
  } catch (const std::exception& error) {
    return refuse(kInternal, error.what());
  }
}

}  // namespace
}  // namespace terracut::cli

int main(int argc, char** argv) {
  using namespace terracut::cli;
  hold_standard_descriptors();
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error of one write, not the process's end
  return end_output(run(std::vector<std::string>(argv + 1, argv + argc)));
}
