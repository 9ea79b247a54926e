// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "configuration_text.hpp"

#include <fmt/format.h>

#include <string_view>

#include "parameter_text.hpp"
#include "pipeline/ground/parameter_table.hpp"
#include "setting_text.hpp"
#include "setup_choice.hpp"
#include "words.hpp"

namespace terracut::cli {
namespace {

constexpr std::string_view kHead =
    "# Configuration of terracut, for all its commands: terracut --config FILE COMMAND ...\n"
    "# A key that is a comment has the default shown; the command line wins over this file.\n"
    "# Relative paths are taken from the folder of this file.\n"
    "# `terracut config --print-default` prints this; `terracut --config FILE config` checks it.\n";

/// Returns a text that YAML reads back unchanged.
std::string quoted_if_needed(std::string_view text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./";
  if (!text.empty() && text.front() != '-' &&
      text.find_first_not_of(kPlain) == std::string_view::npos) {
    return std::string(text);
  }
  if (text.starts_with('-') && text.find_first_not_of("-0123456789.e") == std::string_view::npos) {
    return std::string(text);
  }
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

/// Returns the comment above a key: "Description [unit, range]", and the commands that use the key.
std::string comment(std::string_view indent, std::string_view help, std::string_view unit,
                    std::string_view allowed, std::string_view whose = {}) {
  return fmt::format("{}# {} [{}{}{}]{}\n", indent, help, unit, unit.empty() ? "" : ", ", allowed,
                     whose.empty() ? "" : fmt::format(" ({})", whose));
}

std::string entry(std::string_view indent, std::string_view name, std::string_view value,
                  bool is_default) {
  return fmt::format("{}{}{}:{}{}\n", indent, is_default ? "#" : "", name, value.empty() ? "" : " ",
                     value.empty() ? "" : quoted_if_needed(value));
}

std::string_view section_of(std::string_view key) {
  return key.substr(0, key.find('.'));
}

void add_parameters(std::string& text, const Options& options) {
  MethodOptions without = options.method;
  without.settings.clear();
  const ground::SegmenterConfig defaults = method_config_of(without).segmenter;
  const ground::SegmenterConfig current = method_config_of(options.method).segmenter;
  text += fmt::format(
      "  # The parameters of the method hold in either profile; defaults are those of '{}'.\n",
      word_of(kProfileWords, without.profile));
  std::string_view stage;
  for (const ground::Parameter& parameter : ground::parameters()) {
    if (section_of(parameter.key) != stage) {
      stage = section_of(parameter.key);
      text += fmt::format("  {}:\n", stage);
    }
    const std::string value = parameter.text(current);
    text += comment("    ", parameter.help, parameter.unit, range_text(parameter));
    text += entry("    ", parameter.key.substr(stage.size() + 1), value,
                  value == parameter.text(defaults));
  }
}

}  // namespace

std::string configuration_yaml(const Options& options) {
  const Options defaults;
  std::string text(kHead);
  std::string_view section;
  for (const Setting& setting : settings()) {
    if (setting.key.empty()) continue;
    if (section_of(setting.key) != section) {
      section = section_of(setting.key);
      text += fmt::format("\n{}:\n", section);
    }
    const std::string value = value_text(setting, options);
    text += comment("  ", setting.help, setting.unit, allowed_text(setting),
                    names_of(setting.commands));
    text += entry("  ", setting.key.substr(section.size() + 1), value,
                  value == value_text(setting, defaults));
    if (setting.key == "method.stages") add_parameters(text, options);
  }
  return text;
}

std::string configuration_table() {
  const Options defaults;
  std::string text =
      "| key | unit | range | default | command line | commands | what it is |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Setting& setting : settings()) {
    if (setting.key.empty()) continue;
    const std::string option =
        setting.option.empty() ? std::string() : fmt::format("`{}`", setting.option);
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", setting.key, setting.unit,
                        allowed_text(setting), value_text(setting, defaults), option,
                        names_of(setting.commands), setting.help);
    if (setting.key == "method.stages") {
      text +=
          "| `method.STAGE.NAME` | | | | `--set STAGE.NAME=VALUE` | | Every parameter of "
          "[parameters.md](parameters.md), in either profile |\n";
    }
  }
  return text;
}

}  // namespace terracut::cli
