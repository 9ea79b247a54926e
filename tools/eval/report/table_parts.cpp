// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "table_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "html.hpp"

namespace terracut::evaluation::report {

std::string header(std::string_view html) {
  return fmt::format("<th>{}</th>", html);
}

std::string row_name(std::string_view name, std::string_view what) {
  return fmt::format(R"(<th scope="row">{}</th><td class="what">{}</td>)", escaped(name), what);
}

std::string oracle_title(std::string_view name) {
  return name == "everything_ground" ? "oracle: everything is ground"
                                     : "oracle: perfect on all physical ground";
}

std::vector<std::string> method_names(const Json& evaluation) {
  std::vector<std::string> names;
  for (const auto& [name, method] : evaluation.at("methods").items()) names.push_back(name);
  return names;
}

bool tells_road(const Json& method) {
  return std::ranges::any_of(method.at("by_class"), [](const Json& entry) {
    return entry.at("as_other_ground").get<std::uint64_t>() > 0;
  });
}

bool any_tells_road(const Json& evaluation) {
  return std::ranges::any_of(evaluation.at("methods"), tells_road);
}

}  // namespace terracut::evaluation::report
