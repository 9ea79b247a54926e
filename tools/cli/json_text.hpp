// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace terracut::cli {

/// `json` as the text of a file. Texts that are no UTF-8 (a status page is written by others) come
/// out with U+FFFD instead of throwing.
[[nodiscard]] inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terracut::cli
