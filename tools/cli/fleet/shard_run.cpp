// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "shard_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <utility>

#include "drive_inputs.hpp"
#include "drive_labelling.hpp"
#include "labelled_drive.hpp"
#include "neighbours.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/stop_signal.hpp"
#include "tools/cli/terminal_text.hpp"

namespace terracut::cli {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

ShardRun::ShardRun(const RelabelJob& job, std::string shard)
    : job_(job), shard_(std::move(shard)), started_ns_(measure::realtime_ns()) {}

ExitCode ShardRun::run(const std::vector<FleetDrive>& drives) {
  Progress progress("relabelling", "drives", static_cast<double>(drives.size()));
  const auto go_on = [&] { return !stop_wanted() && !ended_; };
  const auto count = [&] { progress.update(static_cast<double>(labelled_ + there_ + failed_)); };
  std::vector<const FleetDrive*> later;
  for (const FleetDrive& drive : drives) {
    if (!go_on()) break;
    if (!attend(drive, Attention::kIfFree)) later.push_back(&drive);
    count();
  }
  for (const FleetDrive* const drive : later) {
    if (!go_on()) break;
    (void)attend(*drive, Attention::kFinally);
    count();
  }
  return conclude();
}

bool ShardRun::is_there(const RelabelRecord& before, const RelabelRecord& now) const {
  return before.done && before.stamps == now.stamps &&
         !facts_of_whole(job_.folder / before.output).is_null();
}

bool ShardRun::attend(const FleetDrive& drive, Attention attention) {
  RelabelRecord record{.drive = drive.name,
                       .shard = shard_,
                       .host = job_.host,
                       .pid = ::getpid(),
                       .started_ns = measure::realtime_ns()};
  auto stamps = stamps_of(drive);
  if (!stamps) {
    failed(record, note_failure(stamps.error(), record));
    return true;
  }
  record.stamps = *std::move(stamps);
  if (attention == Attention::kFinally) wait_for_neighbours(job_, drive);
  const RelabelRecord before = read_record(job_.state(), drive.name);
  if (is_there(before, record)) {
    ++there_;
    return true;
  }
  if (attention == Attention::kIfFree && seems_under_way(job_, drive)) return false;
  label(drive, std::move(record));
  return true;
}

void ShardRun::label(const FleetDrive& drive, RelabelRecord record) {
  const auto recipe = recipe_of(job_, drive);
  if (!recipe) {
    const ExitCode code = note_failure(recipe.error(), record);
    return failed(record, code);
  }
  record.output = output_name_of(drive, *recipe);
  const Json facts = facts_of_whole(job_.folder / record.output);
  if (!facts.is_null()) {
    take_facts(facts, record);
    ++there_;
    return note(record);
  }
  const ExitCode code = label_drive(job_, drive, *recipe, record);
  if (code == kInterrupted) return;
  if (code != kOk) return failed(record, code);
  ++labelled_;
  frames_ += record.frames;
  say(line_for_terminal(
      fmt::format("{}: {} frames in {:.1f} s", drive.name, record.frames, record.run.seconds)));
  note(record);
}

void ShardRun::failed(const RelabelRecord& record, ExitCode code) {
  if (code == kInterrupted) return;
  ++failed_;
  failures_[record.cause].push_back(record.drive);
  worst_ = code;
  ended_ = ended_ || record.ends_shard;
  say(line_for_terminal(
      fmt::format("error: {}: {}: {}", record.drive, record.cause, record.message)));
  note(record);
}

void ShardRun::note(const RelabelRecord& record) {
  RelabelRecord ended = record;
  ended.ended_ns = measure::realtime_ns();
  // This process's failure must not overwrite another one's success.
  const RelabelRecord before = read_record(job_.state(), record.drive);
  if (!record.done && is_there(before, record)) return;
  // If the disk is full, the next drive's labels end the shard. If only this file cannot be
  // written, only the record is lost.
  if (const Status written = write_record(job_, ended); !written) worst_ = refuse(written.error());
}

ExitCode ShardRun::conclude() const {
  print_out("shard     {} of job {}\n", shard_, job_.id);
  print_out("labelled  {} drives, {} frames, in {:.1f} s\n", labelled_, frames_,
            static_cast<double>(measure::realtime_ns() - started_ns_) * 1e-9);
  print_out("there     {} drives, whole already\n", there_);
  for (const auto& [cause, drives] : failures_) {
    print_out("failed    {} drives: {}: {}\n", drives.size(), cause,
              line_for_terminal(fmt::format("{}", fmt::join(drives, ", "))));
  }
  if (stop_wanted()) return refuse(kInterrupted, "interrupted: the same command goes on");
  return worst_;
}

}  // namespace terracut::cli
