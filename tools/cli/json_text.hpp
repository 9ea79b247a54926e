// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "rt/files/whole_file.hpp"

namespace terracut::cli {

/// `json` as the text of a file. Texts that are no UTF-8 (a status page is written by others) come
/// out with U+FFFD instead of throwing.
[[nodiscard]] inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// The same as a file, whole or not at all; none where `path` is empty.
[[nodiscard]] inline Status write_json(const std::filesystem::path& path,
                                       const nlohmann::ordered_json& json) {
  return path.empty() ? Status{} : files::write_whole_file(path, json_text(json));
}

}  // namespace terracut::cli
