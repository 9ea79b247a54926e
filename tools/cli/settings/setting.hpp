// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/cli/command.hpp"
#include "tools/cli/files/run_files.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// A value chosen from several words.
struct ChoiceField {
  std::vector<std::string_view> words;
  std::string_view chosen;  ///< Empty: none.
  std::function<void(std::size_t)> choose;
};

/// A pointer to the member of Options that stores a setting's value.
using SettingField =
    std::variant<double*, std::optional<double>*, int*, std::optional<int>*, std::uint64_t*,
                 std::uint16_t*, std::optional<std::uint16_t>*, bool*, std::string*,
                 std::filesystem::path*, std::vector<std::string>*, ChoiceField>;

/// The form of a text; setting_text.cpp describes each.
enum class TextForm : std::uint8_t {
  kAny,
  kAddress,
  kSender,  ///< An address, with or without port.
  kVlan,
  kMac,
  kEndpoint,      ///< An address to listen at; a port alone means any.
  kServing,       ///< An address to serve at; a port alone: loopback.
  kServingOrOff,  ///< Like kServing, or "off".
  kStream,        ///< Like kServing, or the path of a socket.
  kName,
  kList,       ///< Texts separated by commas.
  kParameter,  ///< KEY=VALUE for the method.
  kKeyValue,   ///< Any KEY=VALUE.
  kTopic,      ///< A ROS topic, or "off".
};

/// A setting of one or more commands. The table of settings defines the options of the command
/// line, the keys of the configuration file, the messages about wrong ones, and
/// docs/reference/configuration.md. The method's parameters are further keys: "method." and their
/// name in pipeline/ground/parameter_table.hpp.
struct Setting {
  std::string_view key{};     ///< Key in the file, "section.name_unit"; empty: none.
  std::string_view option{};  ///< "--mount-height", "-o,--output", "FILE"; empty: none.
  CommandSet commands{};      ///< Commands that read this setting.
  CommandSet required_by{};
  std::string_view unit{};  ///< "m", "ms", ... or empty
  std::string_view help{};
  double least = 0, most = 0;  ///< Valid range of a number, ends included.
  TextForm form = TextForm::kAny;
  std::string_view bare{};      ///< Value if the option has none; empty: it needs one.
  std::string_view needs{};     ///< Option that must have a value, if the command has it.
  std::string_view excludes{};  ///< Option that must not be given together with this one.
  std::string_view reads{};     ///< For a path to be read: its role, "the calibration".
  std::optional<RunFiles::Kind> writes{};  ///< For a path to be written: its kind.
  std::string_view ending{};               ///< Ending of files in a folder of frames.
  CommandSet denied_to{};                  ///< Commands that refuse it with `denial`.
  std::string_view denial{};               ///< Why these commands refuse it, and the alternative.
  SettingField (*field)(Options&) = nullptr;

  /// Returns the option as people name it: "--output", "FILE".
  [[nodiscard]] std::string_view name() const noexcept {
    return option.substr(option.find(',') + 1);
  }
};

/// Returns all settings; those of the configuration file by section, in the file's order.
[[nodiscard]] std::span<const Setting> settings() noexcept;

/// Returns the setting of that key; null if there is none.
[[nodiscard]] const Setting* find_setting(std::string_view key) noexcept;

/// Returns a command's setting of that option, "--output" or "-o"; null if it has none.
[[nodiscard]] const Setting* find_option(Command command, std::string_view option) noexcept;

}  // namespace terracut::cli
