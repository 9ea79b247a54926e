// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "neighbours.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "rt/files/owned_descriptor.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> parts_beginning_with(const RelabelJob& job, const std::string& prefix) {
  std::vector<fs::path> parts;
  std::error_code error;
  fs::directory_iterator entry(job.parts(), error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (entry->path().filename().native().starts_with(prefix)) parts.push_back(entry->path());
  }
  return parts;
}

}  // namespace

bool seems_under_way(const RelabelJob& job, const FleetDrive& drive) {
  return !parts_beginning_with(job, job.part_prefix(drive)).empty();
}

void wait_for_neighbours(const RelabelJob& job, const FleetDrive& drive) {
  const std::string here = job.part_prefix(drive) + job.host + ".part-";
  for (const fs::path& part : parts_beginning_with(job, here)) {
    const files::OwnedDescriptor opened(::open(part.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    while (opened && !stop_wanted() && ::flock(opened.get(), LOCK_SH) != 0 && errno == EINTR) {
    }
  }
}

}  // namespace terracut::cli
