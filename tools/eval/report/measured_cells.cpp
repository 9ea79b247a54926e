// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "measured_cells.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>

#include "html.hpp"

namespace terracut::evaluation::report {
namespace {

Json::json_pointer pointer_to(const Path& path) {
  Json::json_pointer pointer;
  for (const std::string& key : path) pointer /= key;
  return pointer;
}

/// By key, or, in a list, by place; null where there is no such value.
const Json* value_at(const Json& json, const std::string& key) {
  if (json.is_array()) {
    std::size_t place = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), place);
    const bool whole = error == std::errc{} && end == key.data() + key.size();
    return whole && place < json.size() ? &json[place] : nullptr;
  }
  const auto found = json.is_object() ? json.find(key) : json.end();
  return found == json.end() ? nullptr : &*found;
}

std::string cell(const Path& path, const std::string& text) {
  return fmt::format(R"(<td data-path="{}">{}</td>)", escaped(pointer_to(path).to_string()), text);
}

}  // namespace

std::optional<double> number_at(const Json& evaluation, const Path& path) {
  const Json* at = &evaluation;
  for (const std::string& key : path) {
    const Json* const next = value_at(*at, key);
    if (next == nullptr) return {};
    at = next;
  }
  return at->is_number() ? std::optional(at->get<double>()) : std::nullopt;
}

std::string MeasuredCells::percent(const Path& path) const {
  const auto share = number_at(evaluation_, path);
  return share ? cell(path, fmt::format("{:.2f}", 100 * *share)) : empty_cell();
}

std::string MeasuredCells::ms(const Path& path) const {
  const auto time = number_at(evaluation_, path);
  return time ? cell(path, fmt::format("{:.2f}", *time)) : empty_cell();
}

std::string MeasuredCells::count(const Path& path) const {
  const auto count = number_at(evaluation_, path);
  return count ? cell(path, fmt::format("{:.0f}", *count)) : empty_cell();
}

std::string paper_cell(double value) {
  return fmt::format(R"(<td class="paper">{:.2f}</td>)", value);
}

std::string empty_cell() {
  return "<td>–</td>";
}

}  // namespace terracut::evaluation::report
