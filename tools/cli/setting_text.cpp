// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "setting_text.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "firmware_io/sinks/stream_address.hpp"
#include "rt/number_of.hpp"

namespace terracut::cli {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};

tl::unexpected<Error> wrong(std::string_view expected, std::string_view found) {
  return fail(ErrorCode::kInvalidArgument, fmt::format("expected {}, found '{}'", expected, found));
}

bool is_whole(const SettingField& field) {
  return !std::holds_alternative<double*>(field) &&
         !std::holds_alternative<std::optional<double>*>(field);
}

Expected<double> parse_number(const Setting& setting, bool whole, std::string_view text) {
  const auto number = rt::number_of<double>(text);
  if (number && *number >= setting.least && *number <= setting.most &&
      (!whole || *number == std::floor(*number))) {
    return *number;
  }
  return wrong(fmt::format("a {}number from {} to {}{}{}", whole ? "whole " : "", setting.least,
                           setting.most, setting.unit.empty() ? "" : " ", setting.unit),
               text);
}

bool is_address(std::string_view text) {
  in_addr address{};
  return ::inet_pton(AF_INET, std::string(text).c_str(), &address) == 1;
}

bool is_endpoint(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos || !is_address(text.substr(0, colon))) return false;
  return rt::number_of<std::uint16_t>(text.substr(colon + 1)).value_or(0) != 0;
}

bool is_name(std::string_view text) {
  constexpr std::string_view kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  return !text.empty() && text.size() <= 64 && text.front() != '.' &&
         text.find_first_not_of(kAllowed) == std::string_view::npos;
}

std::string_view description(TextForm form) {
  switch (form) {
    case TextForm::kAddress:
      return "an IPv4 address";
    case TextForm::kEndpoint:
      return "an IPv4 ADDRESS:PORT";
    case TextForm::kEndpointOrOff:
      return "an IPv4 ADDRESS:PORT or off";
    case TextForm::kStream:
      return "an IPv4 ADDRESS:PORT, a PORT or the path of a socket";
    case TextForm::kName:
      return "a name of letters, digits, '-', '_' and '.'";
    case TextForm::kAny:
      break;
  }
  return "text";
}

bool fits(TextForm form, std::string_view text) {
  switch (form) {
    case TextForm::kAddress:
      return is_address(text);
    case TextForm::kEndpoint:
      return is_endpoint(text);
    case TextForm::kEndpointOrOff:
      return text == "off" || is_endpoint(text);
    case TextForm::kStream:
      return firmware_io::parse_stream_address(text).has_value();
    case TextForm::kName:
      return is_name(text);
    case TextForm::kAny:
      break;
  }
  return !text.empty();
}

Status check_text(const Setting& setting, std::string_view text) {
  if (!setting.choices.empty()) {
    if (std::ranges::find(setting.choices, text) != setting.choices.end()) return {};
    return wrong(fmt::format("one of {}", fmt::join(setting.choices, ", ")), text);
  }
  if (!fits(setting.form, text)) return wrong(description(setting.form), text);
  return {};
}

}  // namespace

std::string allowed_text(const Setting& setting) {
  if (!setting.choices.empty()) return fmt::format("{}", fmt::join(setting.choices, ", "));
  Configuration scratch;
  return std::visit(
      Overloaded{[](const bool*) { return std::string("yes, no"); },
                 [](const std::filesystem::path*) { return std::string("file or folder"); },
                 [&](const std::string*) { return std::string(description(setting.form)); },
                 [&](const auto*) { return fmt::format("{} .. {}", setting.least, setting.most); }},
      setting.field(scratch));
}

Status apply_text(const Setting& setting, std::string_view text, const std::filesystem::path& base,
                  Configuration& configuration) {
  const SettingField field = setting.field(configuration);
  const auto set_number = [&]<class Value>(Value* value, auto cast) -> Status {
    const Expected<double> number = parse_number(setting, is_whole(field), text);
    if (!number) return tl::unexpected(number.error());
    *value = static_cast<decltype(cast)>(*number);
    return {};
  };
  return std::visit(
      Overloaded{
          [&](bool* value) -> Status {
            const bool yes = text == "yes" || text == "true";
            if (!yes && text != "no" && text != "false") return wrong("yes or no", text);
            *value = yes;
            return {};
          },
          [&](std::filesystem::path* value) -> Status {
            if (text.empty()) return wrong("a file or folder", text);
            *value = base / text;  // an absolute text replaces the base
            return {};
          },
          [&](std::string* value) -> Status {
            if (Status valid = check_text(setting, text); !valid) return valid;
            *value = std::string(text);
            return {};
          },
          [&](double* value) { return set_number(value, double{}); },
          [&](std::optional<double>* value) { return set_number(value, double{}); },
          [&](int* value) { return set_number(value, int{}); },
          [&](std::optional<int>* value) { return set_number(value, int{}); },
          [&](std::uint64_t* value) { return set_number(value, std::uint64_t{}); },
          [&](std::uint16_t* value) { return set_number(value, std::uint16_t{}); },
          [&](std::optional<std::uint16_t>* value) { return set_number(value, std::uint16_t{}); }},
      field);
}

std::string value_text(const Setting& setting, const Configuration& configuration) {
  Configuration copy = configuration;
  return std::visit(Overloaded{[](const bool* value) { return std::string(*value ? "yes" : "no"); },
                               [](const std::filesystem::path* value) { return value->string(); },
                               [](const std::string* value) { return *value; },
                               []<class T>(const std::optional<T>* value) {
                                 return *value ? fmt::format("{}", **value) : std::string();
                               },
                               [](const auto* value) { return fmt::format("{}", *value); }},
                    setting.field(copy));
}

}  // namespace terracut::cli
