// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "dump_answer.hpp"
#include "pipeline/page/status_page_file.hpp"
#include "pipeline/status/figure_lines.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/export/live_process.hpp"

namespace terracut::cli {

ExitCode run_dump(const Options& options) {
  const std::filesystem::path folder = page::status_page_folder();
  const auto process = find_live_process(folder, options.watched);
  if (!process) return refuse(process.error());
  const auto before = read_dump_answer(folder, process->name);
  if (const Status asked = ask_for_dump(folder, *process); !asked) return refuse(asked.error());

  const auto is_new = [&](const DumpAnswer& answer) {
    return answer.pid == process->pid &&
           (!before || answer.pid != before->pid || answer.serial != before->serial);
  };
  const std::int64_t until_ns =
      measure::monotonic_ns() + static_cast<std::int64_t>(options.wait_s * 1e9);
  do {
    const auto answer = read_dump_answer(folder, process->name);
    if (answer && is_new(*answer)) {
      if (answer->capture.empty()) {
        return refuse(kOutputFailed,
                      fmt::format("refused ({}): {}", status::printable(answer->refusal),
                                  status::printable(answer->message)));
      }
      print_out("{}\n", status::printable(answer->capture));
      say(fmt::format("{} datagrams of {:.2f} s", answer->datagrams, answer->seconds));
      if (!answer->calibration.empty()) {
        say(fmt::format("replay it: terracut replay {} --calibration {}",
                        status::printable(answer->capture),
                        status::printable(answer->calibration)));
      }
      return kOk;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  } while (measure::monotonic_ns() < until_ns);
  return refuse(kOutputFailed,
                fmt::format("'{}' (process {}) was asked, but has not answered within {} s; its "
                            "disk may be slow",
                            process->name, process->pid, options.wait_s));
}

}  // namespace terracut::cli
