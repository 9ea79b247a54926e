// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "option_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string_view>

#include "rt/nearest_word.hpp"
#include "tools/cli/settings/setting.hpp"

namespace terracut::cli {
namespace {

using namespace std::string_view_literals;
constexpr std::string_view kConfig = "--config";

tl::unexpected<Error> wrong(std::string message) {
  return fail(ErrorCode::kInvalidArgument, std::move(message));
}

/// True for an option; false for anything else, such as a negative number.
bool is_option(std::string_view word) {
  return word.size() > 1 && word[0] == '-' && (word[1] < '0' || word[1] > '9') && word[1] != '.';
}

/// Returns "--json" for "--json=r.json" and "-o" for "-or.json".
std::string_view name_in(std::string_view word) {
  return word.starts_with("--") ? word.substr(0, word.find('=')) : word.substr(0, 2);
}

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& words) {
  const std::string_view meant = rt::nearest_word(word, words);
  return meant.empty() ? std::string() : fmt::format(" (did you mean {}?)", meant);
}

Expected<Command> command_named(std::string_view name) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kCommands.size(); ++i) {
    if (kCommands[i].name == name) return static_cast<Command>(i);
    names.push_back(kCommands[i].name);
  }
  return wrong(fmt::format("there is no command '{}'{}; expected one of {}", name,
                           did_you_mean(name, names), fmt::join(names, ", ")));
}

/// Returns why the command does not have the option, if the table of settings states a reason.
std::string_view denial_of(Command command, std::string_view option) {
  for (const Setting& setting : settings()) {
    if (setting.name() == option && setting.denied_to.contains(command)) return setting.denial;
  }
  return {};
}

/// Returns the commands that have the option.
CommandSet commands_with(std::string_view option) {
  CommandSet commands;
  for (const Setting& setting : settings()) {
    if (setting.name() == option) commands = commands | setting.commands;
  }
  return commands;
}

tl::unexpected<Error> unknown(std::optional<Command> command, std::string_view option) {
  const std::string others = names_of(commands_with(option));
  if (!command) {
    if (!others.empty()) return wrong(fmt::format("{} goes behind the command", option));
    return wrong(fmt::format("terracut has no option {}{}", option,
                             did_you_mean(option, {kConfig, "--help"sv, "--version"sv})));
  }
  if (!others.empty()) {
    const std::string_view denial = denial_of(*command, option);
    return wrong(fmt::format("{0} has no option {1}{2}{3}; {1} is of: {4}", name_of(*command),
                             option, denial.empty() ? "" : ": ", denial, others));
  }
  std::vector<std::string_view> names{kConfig, "--help"sv};
  for (const Setting& setting : settings()) {
    const bool is_its = setting.commands.contains(*command) && setting.option.starts_with('-');
    if (is_its) names.push_back(setting.name());
  }
  return wrong(
      fmt::format("{} has no option {}{}", name_of(*command), option, did_you_mean(option, names)));
}

}  // namespace

Status check_names(const std::vector<std::string>& words) {
  std::optional<Command> command;
  for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
    const std::string_view word = words[i];
    if (!is_option(word)) {
      if (command) continue;
      const Expected<Command> named = command_named(word);
      if (!named) return tl::unexpected(named.error());
      command = *named;
      continue;
    }
    const std::string_view name = name_in(word);
    if (name == "--help" || name == "-h" || (name == "--version" && !command)) return {};
    const Setting* const setting = command ? find_option(*command, name) : nullptr;
    if (setting == nullptr && name != kConfig) return unknown(command, name);
    if (setting != nullptr && !setting->bare.empty()) continue;
    const bool is_beside = word.substr(name.size(), 1) == "=";
    const bool has_value =
        name.size() < word.size()
            ? word.size() > name.size() + (is_beside ? 1 : 0)
            : ++i < words.size() && !words[i].empty() && !words[i].starts_with("--");
    if (!has_value) {
      return wrong(
          fmt::format("{}: {} needs a value", command ? name_of(*command) : "terracut", name));
    }
  }
  if (command) return {};
  return wrong("a command is missing, such as `terracut info FILE`");
}

std::filesystem::path configuration_named_in(const std::vector<std::string>& words) {
  std::filesystem::path file;
  for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
    const std::string_view word = words[i];
    if (word == kConfig && i + 1 < words.size()) file = words[++i];
    if (word.starts_with("--config=")) file = word.substr(kConfig.size() + 1);
  }
  return file;
}

}  // namespace terracut::cli
