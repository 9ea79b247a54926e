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

/// What is in a JSON file that others may have written: a plain file of no more than `most_bytes`,
/// of which what lies deeper than 16 levels is left out. The types of what is in it are still to be
/// looked at. kNotFound, kUnreadable, kMalformed.
[[nodiscard]] inline Expected<nlohmann::ordered_json> read_json(const std::filesystem::path& path,
                                                                std::size_t most_bytes) {
  using Ordered = nlohmann::ordered_json;
  constexpr int kDeepest = 16;  // what goes through a value calls itself at each level
  const auto text = files::read_plain_file(path, most_bytes);
  if (!text) return tl::unexpected(text.error());
  try {
    return Ordered::parse(
        *text, [](int depth, Ordered::parse_event_t, Ordered&) { return depth <= kDeepest; });
  } catch (const Ordered::exception& error) {
    return fail(ErrorCode::kMalformed, path.string() + ": " + error.what());
  }
}

/// Whether each of those members of an object is a whole number, or not there. What is another
/// number would be cast to one, and so made anything.
[[nodiscard]] inline bool are_counts(const nlohmann::ordered_json& object,
                                     std::initializer_list<const char*> names) {
  return object.is_object() && std::ranges::all_of(names, [&](const char* name) {
           return !object.contains(name) || object[name].is_number_unsigned();
         });
}

}  // namespace terracut::cli
