// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "rt/files/plain_file.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::cli {

/// Returns `json` as text for a file. Bytes that are not UTF-8, as in status pages of other
/// programs, become U+FFFD instead of throwing.
[[nodiscard]] inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// Writes `json` as text to a file, whole or not at all; writes no file if `path` is empty.
[[nodiscard]] inline Status write_json(const std::filesystem::path& path,
                                       const nlohmann::ordered_json& json) {
  return path.empty() ? Status{} : files::write_whole_file(path, json_text(json));
}

/// Reads a JSON file that others may have written: a plain file of at most `most_bytes`; values
/// nested deeper than 16 levels are left out. The caller checks the values' types. Fails with
/// kNotFound, kUnreadable or kMalformed.
[[nodiscard]] inline Expected<nlohmann::ordered_json> read_json(const std::filesystem::path& path,
                                                                std::size_t most_bytes) {
  using Ordered = nlohmann::ordered_json;
  constexpr int kDeepest = 16;  // functions that visit a value recurse at each level
  const auto text = files::read_plain_file(path, most_bytes);
  if (!text) return tl::unexpected(text.error());
  try {
    return Ordered::parse(
        *text, [](int depth, Ordered::parse_event_t, Ordered&) { return depth <= kDeepest; });
  } catch (const Ordered::exception& error) {
    return fail(ErrorCode::kMalformed, path.string() + ": " + error.what());
  }
}

/// True if each of these members of an object is missing or a whole number. Other values would be
/// cast to arbitrary numbers.
[[nodiscard]] inline bool are_counts(const nlohmann::ordered_json& object,
                                     std::initializer_list<const char*> names) {
  return object.is_object() && std::ranges::all_of(names, [&](const char* name) {
           return !object.contains(name) || object[name].is_number_unsigned();
         });
}

}  // namespace terracut::cli
