// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "option_checks.hpp"

#include <sstream>
#include <string>
#include <vector>

#include "tools/cli/configuration.hpp"

namespace terracut::cli {

CLI::Validator number(double low, double high) {
  return CLI::Validator(
      [low, high](std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) {
          return std::string();
        }
        std::ostringstream message;
        message << "expected a number from " << low << " to " << high << ", found '" << text << "'";
        return message.str();
      },
      "");
}

CLI::Validator range_of(std::string_view key) {
  const Setting* setting = find_setting(key);
  return number(setting->least, setting->most);
}

CLI::IsMember one_of(std::string_view key) {
  const auto& choices = find_setting(key)->choices;
  return CLI::IsMember(std::vector<std::string>(choices.begin(), choices.end()));
}

}  // namespace terracut::cli
