// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "relabel_status.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <map>
#include <system_error>
#include <vector>

#include "labelled_drive.hpp"
#include "relabel_record.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/cli/terminal_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kHour_ns = 3'600'000'000'000;

/// The number and size of the drives in one state.
struct Sum {
  std::uint64_t drives = 0, bytes = 0, frames = 0, label_bytes = 0;
};

struct Tally {
  Sum all, done, lately;  ///< lately: labelled within the last hour
  std::uint64_t missing_bytes = 0;
  std::int64_t lately_since_ns = 0;
  double lately_process_s = 0;
  std::map<std::string, std::vector<std::string>> failures;  ///< "drive: message" by cause.
  std::uint64_t failed = 0;
};

Tally tally_of(const fs::path& folder, const KnownJob& job, std::int64_t now_ns) {
  Tally tally;
  std::error_code vanished;
  tally.lately_since_ns = now_ns;
  for (const auto& [name, bytes] : job.drives) {
    ++tally.all.drives;
    tally.all.bytes += bytes;
    const RelabelRecord record = read_record(job.state, name);
    if (record.drive.empty()) {
      tally.missing_bytes += bytes;
      continue;
    }
    if (!record.done) {
      ++tally.failed;
      tally.failures[line_for_terminal(record.cause)].push_back(
          line_for_terminal(record.drive + ": " + record.message));
      continue;
    }
    // Looks only for the file of the drive's facts, because a fleet has millions of label files;
    // the next run checks all of them.
    if (!fs::exists(folder / record.output / kDriveFacts, vanished)) {
      tally.missing_bytes += bytes;
      continue;
    }
    const auto add = [&, its_bytes = bytes](Sum& sum) {
      ++sum.drives;
      sum.bytes += its_bytes;
      sum.frames += record.frames;
      sum.label_bytes += record.label_bytes;
    };
    add(tally.done);
    if (record.run.seconds == 0 || record.ended_ns < now_ns - kHour_ns) continue;
    add(tally.lately);
    tally.lately_since_ns =
        std::min(tally.lately_since_ns, std::max(record.started_ns, now_ns - kHour_ns));
    tally.lately_process_s += record.run.seconds;
  }
  return tally;
}

std::string bytes_text(std::uint64_t bytes) {
  constexpr double kMega = 1e6, kGiga = 1e9;
  const auto count = static_cast<double>(bytes);
  return count < kGiga ? fmt::format("{:.1f} MB", count / kMega)
                       : fmt::format("{:.1f} GB", count / kGiga);
}

std::string when(std::int64_t ns) {
  const auto seconds = static_cast<std::time_t>(ns / 1'000'000'000);
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(seconds));
}

/// Returns the speed and the expected end; empty if there is no speed yet.
std::string pace_text(const Tally& tally, std::int64_t now_ns) {
  const double span_s = static_cast<double>(now_ns - tally.lately_since_ns) * 1e-9;
  if (tally.lately.drives == 0 || span_s <= 0) return {};
  const double bytes_per_s = static_cast<double>(tally.lately.bytes) / span_s;
  std::string text = fmt::format(
      "speed     {:.1f} frames/s and {:.1f} MB/s of input within the last hour, {:.1f} processes "
      "at "
      "once\n",
      static_cast<double>(tally.lately.frames) / span_s, bytes_per_s * 1e-6,
      tally.lately_process_s / span_s);
  if (tally.missing_bytes == 0 || bytes_per_s <= 0) return text;
  const double left_s = static_cast<double>(tally.missing_bytes) / bytes_per_s;
  constexpr double kYears_s = 3e9;  // records may be another program's, so the speed may be absurd
  if (left_s > kYears_s) return text + "end       not within a hundred years at that speed\n";
  return text + fmt::format("end       in {:.1f} h at that speed, {}\n", left_s / 3600,
                            when(now_ns + static_cast<std::int64_t>(left_s * 1e9)));
}

}  // namespace

Expected<std::string> relabel_status(const fs::path& folder) {
  const auto jobs = jobs_in(folder);
  if (!jobs) return tl::unexpected(jobs.error());
  const KnownJob& job = jobs->back();
  const std::int64_t now_ns = measure::realtime_ns();
  const Tally tally = tally_of(folder, job, now_ns);

  std::string text =
      fmt::format("job       {}, the newest of {}: {} drives, {}, of {}; terracut {}, begun {}\n",
                  line_for_terminal(job.state.filename().string()), jobs->size(), tally.all.drives,
                  bytes_text(tally.all.bytes), line_for_terminal(job.manifest.string()),
                  line_for_terminal(job.version), when(job.began_ns));
  text += fmt::format("done      {} drives, {} frames, {} of labels\n", tally.done.drives,
                      tally.done.frames, bytes_text(tally.done.label_bytes));
  text += fmt::format("missing   {} drives\n", tally.all.drives - tally.done.drives - tally.failed);
  text += fmt::format("failed    {} drives\n", tally.failed);
  for (const auto& [cause, drives] : tally.failures) {
    text += fmt::format("          {}: {}\n", cause, drives.size());
    for (const std::string& drive : drives) text += "            " + drive + "\n";
  }
  text += pace_text(tally, now_ns);
  if (tally.done.drives < tally.all.drives) {
    text += fmt::format("the rest  terracut --config {} relabel {} -o {}\n",
                        shell_word((job.state / kJobSettings).string()),
                        shell_word(job.manifest.string()), shell_word(folder.string()));
  }
  return text;
}

}  // namespace terracut::cli
