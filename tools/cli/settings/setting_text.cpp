// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "setting_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/streams/stream_text.hpp"
#include "pipeline/dds/ros_topic.hpp"
#include "pipeline/stream/stream_address.hpp"
#include "rt/number_of.hpp"
#include "tools/research/baselines/parameter_table.hpp"

namespace terracut::cli {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};

template <class T>
struct ValueOf {
  using type = T;
};
template <class T>
struct ValueOf<std::optional<T>> {
  using type = T;
};

tl::unexpected<Error> wrong(std::string_view expected, std::string_view found) {
  return fail(ErrorCode::kInvalidArgument, fmt::format("expected {}, found '{}'", expected, found));
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

bool is_name(std::string_view text) {
  constexpr std::string_view kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  return !text.empty() && text.size() <= 64 && text.front() != '.' &&
         text.find_first_not_of(kAllowed) == std::string_view::npos;
}

struct Form {
  std::string_view name;         ///< Shown in help.
  std::string_view description;  ///< Shown in messages.
  bool (*fits)(std::string_view text);
};

bool is_text(std::string_view text) {
  return !text.empty();
}

/// Indexed by TextForm.
constexpr std::array kForms{
    Form{"TEXT", "text", is_text},
    Form{"ADDRESS", "an IPv4 address",
         [](std::string_view text) { return net::parse_ipv4_address(text).has_value(); }},
    Form{"ADDRESS[:PORT]", "an IPv4 ADDRESS or ADDRESS:PORT",
         [](std::string_view text) { return net::parse_ipv4_sender(text).has_value(); }},
    Form{"VLAN", "a VLAN's number, OUTER.INNER, or 0 for none",
         [](std::string_view text) { return streams::parse_vlan(text).has_value(); }},
    Form{"MAC", "a link-layer address, like 60:76:88:10:23:a1",
         [](std::string_view text) { return streams::parse_mac(text).has_value(); }},
    Form{"[ADDRESS:]PORT", "an IPv4 ADDRESS:PORT or a PORT",
         [](std::string_view text) { return net::parse_ipv4_endpoint(text).has_value(); }},
    Form{"[ADDRESS:]PORT", "an IPv4 ADDRESS:PORT or a PORT",
         [](std::string_view text) { return stream::parse_serving_endpoint(text).has_value(); }},
    Form{"[ADDRESS:]PORT|off", "an IPv4 ADDRESS:PORT, a PORT or off",
         [](std::string_view text) {
           return text == "off" || stream::parse_serving_endpoint(text).has_value();
         }},
    Form{"[ADDRESS:]PORT|PATH", "an IPv4 ADDRESS:PORT, a PORT or the path of a socket",
         [](std::string_view text) { return stream::parse_stream_address(text).has_value(); }},
    Form{"NAME", "a name of letters, digits, '-', '_' and '.'", is_name},
    Form{"TEXT,TEXT", "texts with commas between", is_text},
    Form{"KEY=VALUE", "KEY=VALUE", is_text},
    Form{"KEY=VALUE", "KEY=VALUE",
         [](std::string_view text) {
           const std::size_t sign = text.find('=');
           return sign != 0 && sign != std::string_view::npos;
         }},
    Form{"TOPIC", "a ROS name, like /points or ~/points, or off",
         [](std::string_view text) { return dds::dds_topic(text, "node").has_value(); }}};

const Form& form_of(const Setting& setting) {
  return kForms[static_cast<std::size_t>(setting.form)];
}

Status check_text(const Setting& setting, std::string_view text) {
  if (setting.form == TextForm::kParameter) {
    baselines::MethodConfig scratch;
    return baselines::apply_setting(scratch, text);
  }
  const Form& form = form_of(setting);
  return form.fits(text) ? Status{} : wrong(form.description, text);
}

Status add_texts(const Setting& setting, std::string_view text, std::vector<std::string>& texts) {
  const bool several = setting.form == TextForm::kList;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = several ? std::min(text.find(',', begin), text.size()) : text.size();
    const std::string_view part = text.substr(begin, end - begin);
    if (Status valid = check_text(setting, part); !valid) return valid;
    texts.emplace_back(part);
    begin = end + 1;
  }
  return {};
}

}  // namespace

std::string_view form_name(const Setting& setting) {
  return form_of(setting).name;
}

std::string allowed_text(const Setting& setting) {
  Options scratch;
  return std::visit(
      Overloaded{
          [](const bool*) { return std::string("yes, no"); },
          [](const std::filesystem::path*) { return std::string("file or folder"); },
          [&](const std::string*) { return std::string(form_of(setting).description); },
          [&](const std::vector<std::string>*) {
            return std::string(form_of(setting).description);
          },
          [](const ChoiceField& field) { return fmt::format("{}", fmt::join(field.words, ", ")); },
          [&](const auto*) { return fmt::format("{} .. {}", setting.least, setting.most); }},
      setting.field(scratch));
}

Status apply_text(const Setting& setting, std::string_view text, const std::filesystem::path& base,
                  Options& options) {
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
            *value = base / text;  // an absolute path replaces the base
            return {};
          },
          [&](std::string* value) -> Status {
            if (Status valid = check_text(setting, text); !valid) return valid;
            *value = std::string(text);
            return {};
          },
          [&](std::vector<std::string>* values) { return add_texts(setting, text, *values); },
          [&](const ChoiceField& field) -> Status {
            const auto word = std::ranges::find(field.words, text);
            if (word == field.words.end()) {
              return wrong(fmt::format("one of {}", fmt::join(field.words, ", ")), text);
            }
            field.choose(static_cast<std::size_t>(word - field.words.begin()));
            return {};
          },
          [&]<class T>(T* value) -> Status {
            using Number = typename ValueOf<T>::type;
            const auto number = parse_number(setting, std::is_integral_v<Number>, text);
            if (!number) return tl::unexpected(number.error());
            *value = static_cast<Number>(*number);
            return {};
          }},
      setting.field(options));
}

std::string value_text(const Setting& setting, const Options& options) {
  Options copy = options;
  return std::visit(Overloaded{[](const bool* value) { return std::string(*value ? "yes" : "no"); },
                               [](const std::filesystem::path* value) { return value->string(); },
                               [](const std::string* value) { return *value; },
                               [](const std::vector<std::string>* values) {
                                 return fmt::format("{}", fmt::join(*values, ","));
                               },
                               [](const ChoiceField& field) { return std::string(field.chosen); },
                               []<class T>(const std::optional<T>* value) {
                                 return *value ? fmt::format("{}", **value) : std::string();
                               },
                               [](const auto* value) { return fmt::format("{}", *value); }},
                    setting.field(copy));
}

}  // namespace terracut::cli
