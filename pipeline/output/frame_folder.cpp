// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/output/frame_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "rt/files/plain_file.hpp"

namespace terracut::output {
namespace {

namespace fs = std::filesystem;

/// The line of a list that names the input of the files begins with this. Earlier versions wrote no
/// such line.
constexpr std::string_view kMadeOf = "of: ";
/// Stands for a line break in a name in a list: a file's name may contain a line break but no
/// slash.
constexpr char kLineBreak = '/';

struct List {
  std::string made_of;  ///< The input; empty if unknown.
  std::set<std::string> names;
};

/// Returns the complete lines of a list file; an empty list if there is no file.
Expected<List> list_in(const fs::path& path) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 28;  // enough for ten million frames
  List list;
  const auto text = files::read_plain_file(path, kMostBytes);
  if (!text && text.error().code == ErrorCode::kNotFound) return list;
  if (!text) return tl::unexpected(text.error());
  std::string_view rest = *text;
  for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    std::string line(rest.substr(0, end));
    rest.remove_prefix(end + 1);
    if (list.made_of.empty() && list.names.empty() && line.starts_with(kMadeOf)) {
      list.made_of = line.substr(kMadeOf.size());
      continue;
    }
    std::ranges::replace(line, kLineBreak, '\n');
    list.names.insert(std::move(line));
  }
  return list;
}

/// Returns the text as one line of a list.
std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
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
  const auto list = list_in(list_path());
  if (!list) return tl::unexpected(list.error());
  std::set<std::string> foreign;
  std::size_t listed = 0;
  std::error_code error;  // a folder that cannot be listed cannot be written either
  fs::directory_iterator entry(config_.folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::string name = entry->path().filename().string();
    if (name.starts_with('.') || !name.ends_with(config_.ending)) continue;
    if (list->names.contains(name)) {
      ++listed;
    } else {
      foreign.insert(std::move(name));
    }
  }
  if (!foreign.empty()) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format("{}: there are {} {} files in it that no earlier run of terracut listed "
                    "as its own, the first {}; files of two origins must not mix: name "
                    "another folder, or move them away",
                    config_.folder.string(), foreign.size(), config_.ending, *foreign.begin()));
  }
  const bool is_same = list->made_of.empty() || list->made_of == one_line(config_.made_of);
  if (listed == 0 || is_same || config_.replaces_others) return {};
  return fail(
      ErrorCode::kInvalidArgument,
      fmt::format("{}: there are {} {} files in it that were made of {}, and would be taken away: "
                  "name another folder, or let them go with --overwrite",
                  config_.folder.string(), listed, config_.ending, list->made_of));
}

Status FrameFolder::begin() {
  if (Status own = check(); !own) return own;
  std::error_code error;
  fs::create_directories(config_.folder, error);
  if (error) return write_failed(config_.folder, error);
  opened_folder_ =
      files::OwnedDescriptor(::open(config_.folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  const auto list = list_in(list_path());
  if (!list) return tl::unexpected(list.error());
  std::size_t removed = 0;
  for (const std::string& name : list->names) {
    // Removes only files whose names place() can have listed.
    if (!name.ends_with(config_.ending)) continue;
    removed += fs::remove(config_.folder / name, error) ? 1 : 0;
    if (error) return write_failed(config_.folder / name, error);
  }
  list_ = files::OwnedDescriptor(
      ::open(list_path().c_str(),
             O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644));
  if (!list_) return write_failed(list_path(), last_error());
  if (removed > 0 && config_.on_replaced) config_.on_replaced(removed);
  if (config_.made_of.empty()) return {};
  Status told = write_line(std::string(kMadeOf) + one_line(config_.made_of));
  if (!told) list_.close();
  return told;
}

Status FrameFolder::write_line(const std::string& text) {
  const std::string line = text + "\n";
  const ::off_t end = ::lseek(list_.get(), 0, SEEK_END);
  const ::ssize_t written = ::write(list_.get(), line.data(), line.size());
  if (written == static_cast<::ssize_t>(line.size())) return {};
  const std::error_code error =
      written < 0 ? last_error() : std::make_error_code(std::errc::no_space_on_device);
  // Removes the partial line, so that a later one begins a line of its own.
  if (written > 0) (void)::ftruncate(list_.get(), end);
  return write_failed(list_path(), error);
}

Status FrameFolder::check_still_there() const {
  struct stat then{};
  struct stat now{};
  const bool is_same = ::fstat(opened_folder_.get(), &then) == 0 &&
                       ::stat(config_.folder.c_str(), &now) == 0 && then.st_dev == now.st_dev &&
                       then.st_ino == now.st_ino;
  if (is_same) return {};
  return fail(ErrorCode::kWriteFailed,
              fmt::format("{}: it was taken away or replaced while the run wrote to it; begin the "
                          "run again",
                          config_.folder.string()));
}

Expected<fs::path> FrameFolder::place(const std::string& name) {
  const Status ready = list_ ? check_still_there() : begin();
  if (!ready) return tl::unexpected(ready.error());
  std::string line = name;
  std::ranges::replace(line, '\n', kLineBreak);
  if (const Status written = write_line(line); !written) return tl::unexpected(written.error());
  return config_.folder / name;
}

}  // namespace terracut::output
