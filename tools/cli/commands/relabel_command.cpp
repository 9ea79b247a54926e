// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <string>

#include "rt/files/part_file.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/fleet/program_run.hpp"
#include "tools/cli/fleet/relabel_job.hpp"
#include "tools/cli/fleet/relabel_status.hpp"
#include "tools/cli/fleet/shard_run.hpp"
#include "tools/cli/stop_signal.hpp"
#include "tools/cli/terminal_text.hpp"

namespace terracut::cli {

ExitCode run_relabel(const Options& options) {
  if (!options.fleet.status.empty()) {
    const auto status = relabel_status(options.fleet.status);
    if (!status) return refuse(status.error());
    print_text(for_terminal(*status));
    return kOk;
  }
  if (options.fleet.manifest.empty() || options.written.empty()) {
    return refuse(kUsage, "relabel: expected MANIFEST and -o FOLDER, or --status FOLDER");
  }
  const auto shard = parse_shard(options.fleet.shard);
  if (!shard) return refuse(shard.error());
  const auto manifest = read_manifest(options.fleet.manifest);
  if (!manifest) return refuse(manifest.error());
  catch_stop_signals(stop_program);
  const auto job = begin_job(options, *manifest);
  if (!job) return refuse_work(job.error());
  files::remove_abandoned_parts(
      job->parts(), [end = "@" + job->host](std::string_view of) { return of.ends_with(end); });
  return ShardRun(*job, options.fleet.shard).run(drives_of(*manifest, *shard));
}

}  // namespace terracut::cli
