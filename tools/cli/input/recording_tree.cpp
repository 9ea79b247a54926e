// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "recording_tree.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <system_error>
#include <utility>

#include "firmware_io/bag/bag.hpp"
#include "firmware_io/capture/file_kind.hpp"
#include "firmware_io/cloud/cloud_file.hpp"
#include "rt/files/ending.hpp"
#include "rt/files/plain_file.hpp"
#include "tools/cli/terminal_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;

/// Folders that file servers and desktops keep for their own use: thumbnails, trash, snapshots.
constexpr std::array kOthersFolders{"@eaDir",       "@Recycle",   "@Recently-Snapshot",
                                    "#recycle",     "#snapshot",  "System Volume Information",
                                    "$RECYCLE.BIN", "lost+found", "__MACOSX"};

/// Files with these endings are not opened: millions of them may lie beside recordings.
constexpr std::array kNoRecordings{".label", ".txt", ".json", ".yaml", ".yml", ".xml",
                                   ".csv",   ".md",  ".log",  ".dbc",  ".png", ".jpg",
                                   ".jpeg",  ".svg", ".html", ".py",   ".sh",  ".parquet"};

bool is_one_of(const auto& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool is_named_as_recording(const fs::path& path) {
  return cloud::is_cloud_file(path) || !capture::capture_stem(path.filename().string()).empty();
}

/// Returns the file's first bytes; an error if it cannot be opened.
Expected<std::vector<std::uint8_t>> first_bytes_of(const fs::path& path) {
  const auto file = files::open_plain_file(path);
  if (!file) return tl::unexpected(file.error());
  std::vector<std::uint8_t> bytes(capture::kFirstBytes);
  const ::ssize_t read = ::read(file->get(), bytes.data(), bytes.size());
  bytes.resize(read < 0 ? 0 : static_cast<std::size_t>(read));
  return bytes;
}

class TreeSearch {
 public:
  explicit TreeSearch(const fs::path& root) {
    for (fs::path at = root; at != at.parent_path();) {
      at = at.parent_path();
      (void)is_first_visit(at);
    }
    look_in(root);
    while (!links_.empty()) look_in(links_.extract(links_.begin()).value());
    std::ranges::sort(found_.left_out, {}, &LeftOut::path);
  }

  [[nodiscard]] RecordingTree take() && { return std::move(found_); }

 private:
  bool is_first_visit(const fs::path& folder) {
    struct stat status{};
    if (::stat(folder.c_str(), &status) != 0) return true;  // listing the folder reports the reason
    return visited_.emplace(status.st_dev, status.st_ino).second;
  }

  void look_in(const fs::path& folder) {
    if (!is_first_visit(folder)) return;
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) look_at(*entry);
    if (error) leave_out(folder, "a folder that cannot be read: " + error.message());
  }

  void look_at(const fs::directory_entry& entry) {
    const fs::path& path = entry.path();
    const std::string name = path.filename().string();
    if (name.starts_with('.')) return;
    std::error_code error;
    const fs::file_status status = entry.status(error);
    if (fs::is_directory(status)) {
      if (is_one_of(kOthersFolders, name)) return;
      if (fs::exists(path / bag::kMetadataFile, error) && bag::is_bag(path)) {
        return take_recording(path, found_.bags);
      }
      if (entry.is_symlink(error)) return void(links_.insert(path));
      return look_in(path);
    }
    if (fs::is_regular_file(status)) return look_at_file(path);
    if (!is_named_as_recording(path)) return;
    const bool leads_nowhere = entry.is_symlink(error) && !fs::exists(status);
    leave_out(path, leads_nowhere ? "a link that leads nowhere" : "neither file nor folder");
  }

  void look_at_file(const fs::path& path) {
    const std::string ending = files::ending_of(path);
    if (cloud::is_cloud_file(path)) return take_cloud(path);
    if (is_named_as_recording(path)) return take_recording(path, found_.captures);
    if (is_one_of(kNoRecordings, ending)) return;
    const bool is_packed_recording = is_named_as_recording(path.stem());
    const auto bytes = first_bytes_of(path);
    if (!bytes) {
      if (is_packed_recording) leave_out(path, "a file that cannot be read");
      return;
    }
    if (capture::begins_as_capture(*bytes)) return take_recording(path, found_.captures);
    if (bag::is_bag(path)) return take_recording(path, found_.bags);
    const auto foreign = capture::foreign_kind(*bytes);
    if (foreign && (!foreign->is_packed || is_packed_recording)) {
      leave_out(path, std::string(foreign->name));
    }
  }

  void take_recording(const fs::path& path, std::set<fs::path>& recordings) {
    if (has_good_name(path)) recordings.insert(path);
  }

  bool has_good_name(const fs::path& path) {
    const bool is_good = is_utf8(path.native());
    if (!is_good) {
      leave_out(path, "a name that is no UTF-8, which a manifest cannot hold; rename it (convmv)");
    }
    return is_good;
  }

  void take_cloud(const fs::path& path) {
    if (!has_good_name(path)) return;
    std::error_code vanished;
    const std::uintmax_t bytes = fs::file_size(path, vanished);
    found_.clouds[path.parent_path()] += vanished ? 0 : bytes;
  }

  void leave_out(const fs::path& path, std::string why) {
    found_.left_out.push_back({path, std::move(why)});
  }

  RecordingTree found_;
  std::set<std::pair<::dev_t, ::ino_t>> visited_;
  std::set<fs::path> links_;  ///< Links to folders; followed after all other paths.
};

}  // namespace

RecordingTree find_recordings(const fs::path& root) {
  return TreeSearch(root).take();
}

}  // namespace terracut::cli
