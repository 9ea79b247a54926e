// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "firmware_io/scan/label_file.hpp"

namespace terracut::cli {

namespace {

bool holds_labels(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::directory_iterator files(folder, error);
  return !error && std::any_of(begin(files), end(files), [](const auto& file) {
    return file.path().extension() == ".label";
  });
}

}  // namespace

Expected<FrameTruth> FrameTruth::open(const std::filesystem::path& folder) {
  if (!folder.empty() && !holds_labels(folder)) {
    return fail(ErrorCode::kNotFound,
                fmt::format("--truth {}: no such folder; expected one of NNNNNN.label, as "
                            "`terracut simulate` writes it",
                            folder.string()));
  }
  return FrameTruth(folder);
}

Status FrameTruth::read(const std::string& name, std::size_t returns) {
  labels_.clear();
  if (!exists()) return {};
  Status read = scan::read_label_file(folder_ / (name + ".label"), returns, labels_);
  if (!read) labels_.clear();
  return read;
}

}  // namespace terracut::cli
