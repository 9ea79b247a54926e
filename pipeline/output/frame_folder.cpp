// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/output/frame_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <set>
#include <string_view>
#include <system_error>

namespace terracut::output {
namespace {

namespace fs = std::filesystem;

/// The whole lines of a list; empty where there is none.
std::set<std::string> names_in(const fs::path& list) {
  std::set<std::string> names;
  std::ifstream file(list, std::ios::binary);
  for (std::string line; std::getline(file, line) && !file.eof();) names.insert(line);
  return names;
}

tl::unexpected<Error> write_failed(const fs::path& path, const std::error_code& error) {
  return fail(ErrorCode::kWriteFailed,
              fmt::format("{}: could not be written: {}. Check the folder, its rights and the free "
                          "space",
                          path.string(), error.message()));
}
std::error_code last_error() {
  return {errno, std::generic_category()};
}

}  // namespace

Status FrameFolder::check() const {
  const std::set<std::string> listed = names_in(list_path());
  std::set<std::string> foreign;
  std::error_code error;  // a folder that cannot be listed cannot be written to either
  fs::directory_iterator entry(folder_, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::string name = entry->path().filename().string();
    if (name.starts_with('.') || !name.ends_with(ending_) || listed.contains(name)) continue;
    foreign.insert(std::move(name));
  }
  if (foreign.empty()) return {};
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("{}: there are {} {} files in it that no earlier run of terracut listed "
                          "as its own, the first {}; files of two origins must not mix: name "
                          "another folder, or move them away",
                          folder_.string(), foreign.size(), ending_, *foreign.begin()));
}

Status FrameFolder::begin() {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) return write_failed(folder_, error);
  for (const std::string& name : names_in(list_path())) {
    // Only what place() can have listed: a plain name of this ending.
    if (name.find('/') != std::string::npos || !name.ends_with(ending_)) continue;
    fs::remove(folder_ / name, error);
    if (error) return write_failed(folder_ / name, error);
  }
  list_ = files::OwnedDescriptor(
      ::open(list_path().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644));
  if (!list_) return write_failed(list_path(), last_error());
  return {};
}

Expected<fs::path> FrameFolder::place(const std::string& name) {
  if (!list_) {
    if (const Status begun = begin(); !begun) return tl::unexpected(begun.error());
  }
  const std::string line = name + "\n";
  const ::ssize_t written = ::write(list_.get(), line.data(), line.size());
  if (written != static_cast<::ssize_t>(line.size())) {
    return write_failed(list_path(), written < 0
                                         ? last_error()
                                         : std::make_error_code(std::errc::no_space_on_device));
  }
  return folder_ / name;
}

}  // namespace terracut::output
