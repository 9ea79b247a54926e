// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "method_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/research/baselines/parameter_table.hpp"

namespace terracut::eval {
namespace {

/// True if `name` can be the name of a folder.
bool is_name(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

/// Removes "a" from the front of "a,b,c" and returns it.
std::string_view take_part(std::string_view& text) {
  const std::size_t comma = text.find(',');
  const std::string_view part = text.substr(0, comma);
  text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
  return part;
}

}  // namespace

Expected<MethodChoice> method_named(std::string_view name) {
  const auto config = baselines::method_named(name);
  if (!config) return tl::unexpected(config.error());
  MethodChoice choice{std::string(name), {}, std::string(name), *config};
  for (const baselines::MethodName& known : baselines::method_names()) {
    if (known.name == name) choice.about = known.about;
  }
  return choice;
}

Expected<MethodChoice> method_variant(std::string_view text,
                                      std::span<const std::string> settings) {
  const auto refuse = [&](std::string_view why) {
    return fail(ErrorCode::kInvalidArgument, fmt::format("variant '{}': {}", text, why));
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) {
    return refuse("expected NAME=METHOD,KEY=VALUE,...");
  }
  const std::string_view name = text.substr(0, equals);
  if (!is_name(name)) return refuse("its name takes letters, digits, _ and - alone");
  if (baselines::method_named(name)) return refuse("its name is that of a method");
  std::string_view rest = text.substr(equals + 1);
  auto choice = method_named(take_part(rest));
  if (!choice) return refuse(choice.error().message);
  choice->name = name;
  if (!rest.empty()) choice->about += fmt::format("; {}", rest);
  for (const std::string& setting : settings) {
    if (const Status made = baselines::apply_setting(choice->config, setting); !made) {
      return refuse(made.error().message);
    }
  }
  while (!rest.empty()) {
    const std::string_view setting = take_part(rest);
    if (const Status made = baselines::apply_setting(choice->config, setting); !made) {
      return refuse(made.error().message);
    }
    const std::string_view key = setting.substr(0, setting.find('='));
    if (baselines::kind_that_uses(key) != choice->config.kind) {
      return refuse(fmt::format("'{}' is a parameter of another method", key));
    }
  }
  return choice;
}

}  // namespace terracut::eval
