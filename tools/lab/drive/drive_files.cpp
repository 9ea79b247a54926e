// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "drive_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string>
#include <utility>

#include "firmware_io/scan/label_file.hpp"
#include "rt/files/part_file.hpp"

namespace terracut::drive {
namespace fs = std::filesystem;
namespace {

bool is_label_name(const std::string& name) {
  constexpr std::size_t kDigits = 6;
  return name.size() == kDigits + 6 && name.ends_with(".label") &&
         std::all_of(name.begin(), name.begin() + kDigits,
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

Status check_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return {};
  if (!fs::is_directory(folder, error)) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format("{}: expected a folder of truth labels or nothing, found a file; move it "
                    "away or choose another output name",
                    folder.string()));
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (!is_label_name(entry.path().filename().string())) {
      return fail(
          ErrorCode::kInvalidArgument,
          fmt::format("{}: expected only NNNNNN.label files, found '{}'; the folder would be "
                      "replaced, so move it away or choose another output name",
                      folder.string(), entry.path().filename().string()));
    }
  }
  return {};
}

/// Exchanges two folders in one step, so that a process killed at this point has lost neither.
/// Returns false if one is missing or the file system cannot exchange folders.
bool exchange(const fs::path& a, const fs::path& b) noexcept {
  return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

tl::unexpected<Error> write_failed(const fs::path& path, const std::string& reason) {
  return fail(ErrorCode::kWriteFailed,
              fmt::format("{}: could not be written: {}; nothing was left in its place. Check the "
                          "free space and the folder's permissions",
                          path.string(), reason));
}

}  // namespace

fs::path truth_folder_of(const fs::path& pcap_path) {
  return pcap_path.parent_path() / (pcap_path.stem().string() + ".truth");
}

/// The staging folder, which is removed with this object.
class DriveFiles::Staging {
 public:
  explicit Staging(files::Part part) : part_(std::move(part)) {}
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;
  ~Staging() {
    std::error_code ignored;
    fs::remove_all(part_.path, ignored);
  }
  [[nodiscard]] fs::path truth() const { return part_.path / "truth"; }
  [[nodiscard]] fs::path old_truth() const { return part_.path / "old-truth"; }
  [[nodiscard]] fs::path calibration() const { return part_.path / "calibration"; }

 private:
  files::Part part_;
};

DriveFiles::DriveFiles(fs::path truth, std::unique_ptr<Staging> staging) noexcept
    : truth_(std::move(truth)), staging_(std::move(staging)) {}
DriveFiles::DriveFiles(DriveFiles&&) noexcept = default;
DriveFiles& DriveFiles::operator=(DriveFiles&&) noexcept = default;
DriveFiles::~DriveFiles() = default;

Expected<DriveFiles> DriveFiles::create(const fs::path& pcap_path) {
  const fs::path truth = truth_folder_of(pcap_path);
  if (const Status usable = check_folder(truth); !usable) return tl::unexpected(usable.error());
  files::Part part = files::make_part_folder(truth);
  if (!part.lock) return write_failed(pcap_path, "no temporary folder can be made in its folder");
  DriveFiles files(truth, std::make_unique<Staging>(std::move(part)));
  std::error_code error;
  fs::create_directory(files.staging_->truth(), error);
  if (error) return write_failed(truth, error.message());
  return files;
}

fs::path DriveFiles::staged_calibration() const {
  return staging_->calibration();
}

Status DriveFiles::write_truth(std::uint64_t frame, std::span<const std::uint32_t> labels) {
  const Status written =
      scan::write_label_ids(staging_->truth() / fmt::format("{:06}.label", frame), labels);
  if (!written) return write_failed(truth_, "a label file was refused");
  return {};
}

Status DriveFiles::check_replaceable() const {
  return check_folder(truth_);
}

Status DriveFiles::put_in_place(const fs::path& calibration_path) {
  std::error_code error;
  if (!exchange(staging_->truth(), truth_)) {
    if (fs::exists(truth_, error)) fs::rename(truth_, staging_->old_truth(), error);
    if (!error) fs::rename(staging_->truth(), truth_, error);
  }
  if (error) return write_failed(truth_, error.message());
  if (calibration_path.empty()) return {};
  fs::rename(staging_->calibration(), calibration_path, error);
  if (error) return write_failed(calibration_path, error.message());
  return {};
}

}  // namespace terracut::drive
