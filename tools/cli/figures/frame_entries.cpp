// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_entries.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include "rt/files/part_file.hpp"
#include "tools/cli/json_text.hpp"

namespace terracut::cli {
namespace {

constexpr std::size_t kPiece_bytes = 1 << 16;
constexpr std::string_view kNoFrames =
    "\n \"frames\": []";  // occurs once: newlines in texts are escaped

Error cannot_keep(const std::filesystem::path& path, int error_number) {
  return {ErrorCode::kWriteFailed,
          fmt::format("could not keep the frames of {} beside it: {}", path.string(),
                      std::generic_category().message(error_number))};
}

}  // namespace

FrameEntries::FrameEntries(const std::filesystem::path& report) {
  std::error_code error;
  if (report.has_parent_path()) std::filesystem::create_directories(report.parent_path(), error);
  files::Part part = files::make_part_file(report);
  if (!part.lock || ::unlink(part.path.c_str()) != 0) error_number_ = errno;
  file_ = std::move(part.lock);
}

void FrameEntries::add(const nlohmann::ordered_json& entry) {
  pending_ += bytes_ + pending_.size() == 0 ? "\n" : ",\n";
  const std::string text = json_text(entry);
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = text.find('\n', begin);
    pending_.append("  ").append(text, begin, end - begin).append(1, '\n');
  }
  pending_.pop_back();
  if (pending_.size() >= kPiece_bytes) flush();
}

void FrameEntries::flush() {
  for (std::string_view rest = pending_; error_number_ == 0 && !rest.empty();) {
    const ::ssize_t written = ::write(file_.get(), rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      error_number_ = errno;
      break;
    }
    bytes_ += static_cast<std::uint64_t>(written);
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  pending_.clear();
}

Status FrameEntries::write(const std::filesystem::path& path,
                           const nlohmann::ordered_json& report) {
  flush();
  if (error_number_ != 0) return tl::unexpected(cannot_keep(path, error_number_));
  const std::string text = json_text(report);
  const std::size_t at = text.find(kNoFrames);
  if (bytes_ == 0 || at == std::string::npos) return files::write_whole_file(path, text);
  const std::string before = text.substr(0, at + kNoFrames.size() - 1);
  const std::string behind = "\n " + text.substr(before.size());
  std::string piece(kPiece_bytes, '\0');
  ::off_t at_byte = 0;
  enum { kBefore, kFrames, kEnd } step = kBefore;
  return files::write_whole_file(path, [&]() -> Expected<std::string_view> {
    if (std::exchange(step, step == kBefore ? kFrames : step) == kBefore) return before;
    if (step == kEnd) return std::string_view();
    const ::ssize_t got = ::pread(file_.get(), piece.data(), piece.size(), at_byte);
    if (got < 0) return tl::unexpected(cannot_keep(path, errno));
    at_byte += got;
    if (got > 0) return std::string_view(piece).substr(0, static_cast<std::size_t>(got));
    step = kEnd;
    return behind;
  });
}

}  // namespace terracut::cli
