// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "labelling.hpp"

#include <system_error>
#include <utility>

#include "tools/cli/fleet/labelled_drive.hpp"
#include "tools/cli/fleet/relabel_job.hpp"
#include "tools/cli/fleet/relabel_record.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;

Labelling labelling_of(const KnownJob& job) {
  Labelling labelling{{}, job.state};
  const fs::path folder = job.state.parent_path().parent_path();
  for (const auto& drive : job.drives) {
    const RelabelRecord record = read_record(job.state, drive.name);
    if (!record.done || facts_of_whole(folder / record.output).is_null()) continue;
    labelling.drives[record.drive] = folder / record.output;
  }
  return labelling;
}

Expected<Labelling> plain_labelling(const fs::path& folder) {
  Labelling labelling;
  std::error_code error, none;
  fs::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const fs::path& path = entry->path();
    if (path.extension() != ".label" || path.filename().native().starts_with('.')) continue;
    const fs::path place = path.parent_path();
    labelling.drives[place.lexically_relative(folder).string()] = place;
  }
  // Without this error, a folder that cannot be listed would silently be left out of the
  // comparison.
  if (error && fs::exists(folder, none)) {
    return fail(ErrorCode::kUnreadable,
                folder.string() + ": a folder in it cannot be listed: " + error.message());
  }
  return labelling;
}

}  // namespace

Expected<Labelling> find_labelling(const fs::path& folder) {
  std::error_code error;
  Labelling labelling;
  if (fs::exists(folder / "job.json", error)) {
    const auto job = read_job(fs::absolute(folder).lexically_normal());
    if (!job) return tl::unexpected(job.error());
    labelling = labelling_of(*job);
  } else if (fs::exists(folder / ".relabel", error)) {
    const auto jobs = jobs_in(folder);
    if (!jobs) return tl::unexpected(jobs.error());
    labelling = labelling_of(jobs->back());
  } else {
    auto plain = plain_labelling(folder);
    if (!plain) return plain;
    labelling = *std::move(plain);
  }
  if (!labelling.drives.empty()) return labelling;
  return fail(ErrorCode::kNotFound, folder.string() + ": there are no label files in it");
}

}  // namespace terracut::cli
